//! Results of the paper, each from one command.

mod bars;
mod convergence;
mod dam_break;
mod head;
mod jet;
mod ledger;
mod sand_column;
mod u_tube;

use crate::arguments::ReproduceOptions;
use crate::outcome::Failure;
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
        name: "u-tube",
        about: "water seeps through soil from one arm of a U-tube to the other, 200 s: levels and flow against \
                the exact course (paper, Figs. 9 and 10)",
        run: u_tube::reproduce,
    },
    Reproduction {
        name: "jet",
        about: "a jet of 25 m/s digs into saturated soil: flow, hole, volume fraction, plastic strain (paper, \
                Figs. 12 to 16)",
        run: jet::reproduce,
    },
    Reproduction {
        name: "jet-conductivity",
        about: "the same for soils from gravel to sand: depth of the hole (paper, Fig. 17)",
        run: jet::series::conductivity,
    },
    Reproduction {
        name: "jet-fraction",
        about: "the same for loose and dense soil: shape of the hole (paper, Fig. 18)",
        run: jet::series::fraction,
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
pub fn list() {
    for Reproduction { name, about, .. } in ALL {
        println!("{name}\n    {about}");
    }
}

fn bad_table(name: &str, error: &TableError) -> Failure {
    Failure::File(std::io::Error::other(format!("{name}: {error}")))
}
