//! The commands' cases are read without an error, with both presets, quick and whole.

use super::*;
use crate::arguments::{Existing, PrecisionName, PresetName};

fn options(preset: PresetName, quick: bool) -> ReproduceOptions {
    let output = OutputOptions { out: None, existing: Existing::Error, threads: None };
    let (name, precision) = ("mixture".to_owned(), PrecisionName::F64);
    ReproduceOptions { name, quick, preset, precision, spacing: None, output }
}

#[test]
fn every_case_is_one_of_soil_and_water() {
    for preset in [PresetName::Default, PresetName::Paper] {
        for quick in [false, true] {
            let options = options(preset, quick);
            let texts = [
                saturated_rest::text("flush", 0.0, &options),
                saturated_rest::text("drowned", 0.05, &options),
                consolidation::text(&options, 1.0),
                bank_erosion::text(&options, 0.01),
                darcy_column::text(&options, 1),
                submerged_collapse::text(&options, 0.01),
                settling::text(&options),
            ];
            for text in texts {
                let case = Case::parse("mixture", &text).unwrap_or_else(|error| panic!("{error}\n{text}")).0;
                assert!(case.soil.is_some() && case.water.is_some() && case.mixing.is_some(), "{text}");
            }
        }
    }
}
