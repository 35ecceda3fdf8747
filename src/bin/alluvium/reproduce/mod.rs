//! Results of the paper, each from one command.

mod dam_break;
mod front;

use crate::arguments::ReproduceOptions;
use crate::outcome::Failure;

struct Reproduction {
    name: &'static str,
    about: &'static str,
    run: fn(&ReproduceOptions) -> Result<(), Failure>,
}

const ALL: &[Reproduction] = &[Reproduction {
    name: "dam-break",
    about: "the collapse of a column of water, 12 800 particles: front against Martin & Moyce and \
            Koshizuka & Oka, pressure, energy budget (paper, Figs. 2 and 3)",
    run: dam_break::reproduce,
}];

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
