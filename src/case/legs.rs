//! A path of one's own for the [driver](crate::driver): legs in a file, read as strictly as a case.

use super::bounds::{Bounds, from_to};
use super::choice::{Choice, Component};
use super::problem::CaseError;
use super::reader::Reader;
use super::section::Section;
use crate::driver::{Control, Leg};
use crate::real::Real;
use crate::space::SymTensor;

const STRAINS: [&str; 6] = ["strain_xx", "strain_yy", "strain_zz", "strain_xy", "strain_yz", "strain_xz"];
const STRESSES: [&str; 6] =
    ["stress_xx_pa", "stress_yy_pa", "stress_zz_pa", "stress_xy_pa", "stress_yz_pa", "stress_xz_pa"];
const ROTATIONS: [&str; 3] = ["rotation_xy_deg", "rotation_yz_deg", "rotation_xz_deg"];

const STRAIN: Bounds = from_to(-10.0, 10.0, "positive in extension");
const STRESS: Bounds = from_to(-1e13, 1e13, "Pa, positive in tension");
const ANGLE: Bounds = from_to(-36_000.0, 36_000.0, "°, from the first axis towards the second");

/// A path of one's own: legs one after another, all of them as often as told.
///
/// ```
/// use alluvium::case::OwnPath;
/// // A triaxial test to and fro between two axial stresses.
/// let path = OwnPath::<f64>::parse("legs.toml", r#"
///     cycles = 10
///     [[leg]]
///     held = ["xx", "yy"]
///     stress_zz_pa = -1.5e5
///     [[leg]]
///     held = ["xx", "yy"]
///     stress_zz_pa = -0.8e5
///     increments = 20
/// "#).map_err(|error| error.to_string())?;
/// assert_eq!((path.cycles, path.legs.len()), (10, 2));
/// # Ok::<(), String>(())
/// ```
/// `docs/case-format.md` lists every key.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnPath<T> {
    /// How often the legs are gone along.
    pub cycles: usize,
    /// The legs, one after another.
    pub legs: Vec<OwnLeg<T>>,
}

/// One leg of an own path.
#[derive(Clone, Debug, PartialEq)]
pub struct OwnLeg<T> {
    /// What is held and what moves.
    pub leg: Leg<T>,
    /// In how many increments, if the file says so.
    pub increments: Option<usize>,
}

impl<T: Real> OwnPath<T> {
    /// Reads a path from `text`; `file` is the name used in messages.
    ///
    /// # Errors
    /// Everything that is wrong with it: text that is not TOML, unknown keys, wrong types, values out of range, a
    /// component with two controls, a leg that leads nowhere, no leg.
    pub fn parse(file: &str, text: &str) -> Result<Self, CaseError> {
        let reader = Reader::new(text);
        let path = reader.with_root(|root| path(&reader, root));
        let (problems, _) = reader.finish();
        match path {
            Some(path) if problems.is_empty() => Ok(path),
            _ => Err(CaseError { file: file.to_owned(), problems }),
        }
    }
}

fn path<T: Real>(reader: &Reader<'_>, root: &Section<'_, '_>) -> OwnPath<T> {
    let cycles = root.count("cycles", 1..=100_000).unwrap_or(1) as usize;
    let sections = root.sections("leg");
    if sections.is_empty() && !reader.given("leg") {
        reader.missing("", "leg", "at least one [[leg]]".to_owned());
    }
    let legs = (1..).zip(&sections).map(|(n, section)| leg(reader, section, n)).collect();
    root.finish();
    OwnPath { cycles, legs }
}

fn leg<T: Real>(reader: &Reader<'_>, section: &Section<'_, '_>, number: usize) -> OwnLeg<T> {
    let held = section.choices::<Component>("held").unwrap_or_default();
    let mut leg = Leg::strain(SymTensor::zero());
    for &component in Component::ALL {
        leg.controls[component as usize] = control(reader, section, component, held.contains(&component));
    }
    for (turn, key) in leg.rotation.iter_mut().zip(ROTATIONS) {
        // The spin is positive from the second axis towards the first.
        *turn = T::of(-section.number(key, ANGLE).unwrap_or(0.0).to_radians());
    }
    let increments = section.count("increments", 1..=1_000_000).map(|n| n as usize);
    section.finish();
    let moves = |control: &Control<T>| match control {
        Control::Strain(strain) => *strain != T::ZERO,
        Control::Stress(_) => true,
        Control::Held => false,
    };
    let rests = !leg.controls.iter().any(moves) && leg.rotation.iter().all(|turn| *turn == T::ZERO);
    if rests && section.is_given() {
        let allowed = "a strain or a rotation that is not 0, or a stress to go to";
        reader.error(&format!("leg[{number}]"), "leads nowhere", allowed);
    }
    OwnLeg { leg, increments }
}

/// Strain, stress or neither of one component; what is not named does not strain.
fn control<T: Real>(
    reader: &Reader<'_>,
    section: &Section<'_, '_>,
    component: Component,
    is_held: bool,
) -> Control<T> {
    let [strain_key, stress_key] = [STRAINS[component as usize], STRESSES[component as usize]];
    let strain = section.number(strain_key, STRAIN);
    let stress = section.number(stress_key, STRESS);
    if strain.is_some() && stress.is_some() {
        let why = format!("contradicts {strain_key}");
        reader.error(&section.name(stress_key), &why, format!("either {strain_key} or {stress_key}"));
    }
    if is_held && (strain.is_some() || stress.is_some()) {
        let key = if strain.is_some() { strain_key } else { stress_key };
        reader.error(
            &section.name(key),
            "contradicts held",
            format!("either {key} or \"{component}\" in held"),
        );
    }
    match (strain, stress) {
        (_, Some(stress)) => Control::Stress(T::of(stress)),
        (None, None) if is_held => Control::Held,
        (strain, None) => Control::Strain(T::of(strain.unwrap_or(0.0))),
    }
}
