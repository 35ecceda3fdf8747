//! Results of the paper, each from one command.

mod bars;
mod convergence;
mod dam_break;
mod head;
mod jet;
mod ledger;
mod mixture;
mod results;
mod sand_column;
mod u_tube;
mod vertical_cut;

use crate::arguments::ReproduceOptions;
use crate::outcome::Failure;
use crate::screen;
use alluvium::output::TableError;

struct Reproduction {
    name: &'static str,
    about: &'static str,
    run: fn(&ReproduceOptions) -> Result<(), Failure>,
}

const ALL: &[Reproduction] = &[
    Reproduction {
        name: "dam-break",
        about: "the collapse of a column of water, 12 800 particles: front against Martin & Moyce and \
                Koshizuka & Oka, pressure, energy budget (paper, Figs. 2 and 3)",
        run: dam_break::reproduce,
    },
    Reproduction {
        name: "dam-break-convergence",
        about: "the same at four resolutions: error of the horizontal velocity at t = 0.2 s against a \
                finite-volume solution, and its order (paper, Fig. 5)",
        run: convergence::reproduce,
    },
    Reproduction {
        name: "sand-column",
        about: "the collapse of a column of sand, 12 800 particles: final surface and failure line against \
                Bui et al. 2008, plastic strain, energy budget; beside it the paper's flow rule",
        run: sand_column::reproduce,
    },
    Reproduction {
        name: "sand-column-run-out",
        about: "columns of aspect ratios from 0.5 to 4: how far they run, over laws from other experiments",
        run: sand_column::run_out::reproduce,
    },
    Reproduction {
        name: "sand-column-round",
        about: "a round column of the same sand in three dimensions: surface, how far it runs",
        run: sand_column::in_space::round,
    },
    Reproduction {
        name: "sand-column-channel",
        about: "a column of it in a channel, in three dimensions: surface, how far it runs",
        run: sand_column::in_space::channel,
    },
    Reproduction {
        name: "vertical-cut",
        about: "cuts in cohesive soil below and above the critical height: one stands, one falls",
        run: vertical_cut::reproduce,
    },
    Reproduction {
        name: "u-tube",
        about: "water seeps through soil from one arm of a U-tube to the other, 200 s: levels, flow and errors against \
                the exact course, head along the soil (paper, Figs. 9 and 10)",
        run: u_tube::reproduce,
    },
    Reproduction {
        name: "jet",
        about: "a jet of 25 m/s digs into saturated soil: flow, hole, volume fraction, effective pressure, plastic \
                strain (paper, Figs. 12 to 16)",
        run: jet::reproduce,
    },
    Reproduction {
        name: "jet-conductivity",
        about: "the same for soils from gravel to clay, drag solved over the step in the finer ones: depth of the hole \
                (paper, Fig. 17)",
        run: jet::series::conductivity,
    },
    Reproduction {
        name: "jet-fraction",
        about: "the same for loose and dense soil: shape of the hole (paper, Fig. 18)",
        run: jet::series::fraction,
    },
    Reproduction {
        name: "saturated-rest",
        about: "the jet's bed without a jet, flush and under water, for half a second: it must not move",
        run: mixture::saturated_rest::reproduce,
    },
    Reproduction {
        name: "darcy-column",
        about: "water driven through soil and round again for five pore volumes: flow, pressure and crowding \
                against Darcy's law",
        run: mixture::darcy_column::reproduce,
    },
    Reproduction {
        name: "consolidation",
        about: "mud settles as its water drains: pressure and settlement against Terzaghi's series",
        run: mixture::consolidation::reproduce,
    },
    Reproduction {
        name: "settling",
        about: "loose soil sinks through water: slip and gradient against their exact values",
        run: mixture::settling::reproduce,
    },
    Reproduction {
        name: "submerged-collapse",
        about: "a column of sand collapses under water: flow, surface, plastic strain",
        run: mixture::submerged_collapse::reproduce,
    },
    Reproduction {
        name: "bank-erosion",
        about: "water flows over a saturated bank and down its face: flow, surface, what is taken along",
        run: mixture::bank_erosion::reproduce,
    },
];

/// `alluvium reproduce NAME`.
pub fn reproduce(options: &ReproduceOptions) -> Result<(), Failure> {
    match ALL.iter().find(|reproduction| reproduction.name == options.name) {
        Some(reproduction) => (reproduction.run)(options),
        None => {
            let names: Vec<_> = ALL.iter().map(|reproduction| reproduction.name).collect();
            let what = format!("nothing is called `{}`; there is {}", options.name, names.join(", "));
            Err(Failure::Usage(what))
        }
    }
}

/// `alluvium list`.
pub fn list() -> Result<(), Failure> {
    for Reproduction { name, about, .. } in ALL {
        screen::print(format_args!("{name}\n    {about}"))?;
    }
    Ok(())
}

fn bad_table(name: &str, error: &TableError) -> Failure {
    Failure::File(std::io::Error::other(format!("{name}: {error}")))
}
