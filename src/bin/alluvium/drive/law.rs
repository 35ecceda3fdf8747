//! From options to a law, a path and its answer.

use super::{Answer, DriveOptions, PathName, SurfaceName, own};
use crate::outcome::Failure;
use alluvium::driver::{Driver, Kind, Path};
use alluvium::material::{
    DruckerPrager, Elasticity, Material, MohrCoulomb, Soil, SoilMemory, Unyielding, YieldSurface,
};
use alluvium::{Real, SymTensor};

/// Density of the grains \[kg/m³\]: no answer depends on it.
const DENSITY: f64 = 2650.0;
/// Pressure at the start \[Pa\], strain \[-\] and angle \[°\] if none is given.
const CONFINING_STRESS: f64 = 1e5;
const STRAIN: f64 = 0.05;
const ANGLE: f64 = 45.0;

pub fn drive<T: Real>(options: &DriveOptions) -> Result<Answer, Failure> {
    let law = &options.law;
    let [friction, dilatancy] =
        [law.friction_angle, law.dilatancy_angle].map(|angle| T::of(angle.unwrap_or(0.0).to_radians()));
    let cohesion = T::of(law.cohesion.unwrap_or(0.0));
    let cone = law.cone.map(|name| name.cone()).unwrap_or_default();
    match law.surface {
        SurfaceName::DruckerPrager => {
            let surface = DruckerPrager::cohesive(cone, friction, dilatancy, cohesion)?;
            let largest = law.tension_cut_off.map_or(T::INFINITY, T::of);
            along(surface.with_tension_cut_off(largest)?, options)
        }
        SurfaceName::MohrCoulomb => {
            let given =
                [("--cone", law.cone.is_some()), ("--tension-cut-off", law.tension_cut_off.is_some())];
            unused("mohr-coulomb", &given)?;
            along(MohrCoulomb::cohesive(friction, dilatancy, cohesion)?, options)
        }
        SurfaceName::Elastic => {
            let given = [
                ("--friction-angle", law.friction_angle.is_some()),
                ("--dilatancy-angle", law.dilatancy_angle.is_some()),
                ("--cohesion", law.cohesion.is_some()),
                ("--tension-cut-off", law.tension_cut_off.is_some()),
                ("--cone", law.cone.is_some()),
                ("--plasticity", law.plasticity.is_some()),
            ];
            unused("elastic", &given)?;
            along::<T, _>(Unyielding, options)
        }
    }
}

fn unused(surface: &str, given: &[(&str, bool)]) -> Result<(), Failure> {
    match given.iter().find(|(_, given)| *given) {
        Some((flag, _)) => {
            Err(Failure::Usage(format!("{flag} has no meaning with --surface {surface}: leave it out")))
        }
        None => Ok(()),
    }
}

fn along<T: Real, Y: YieldSurface<T>>(surface: Y, options: &DriveOptions) -> Result<Answer, Failure> {
    let law = &options.law;
    let ratio = T::of(law.poissons_ratio);
    let elasticity = match (law.youngs_modulus, law.bulk_modulus) {
        (Some(modulus), _) => Elasticity::new(T::of(modulus), ratio)?,
        (None, Some(modulus)) => Elasticity::from_bulk(T::of(modulus), ratio)?,
        (None, None) => return Err(Failure::Usage("give --youngs-modulus or --bulk-modulus".to_owned())),
    };
    let start = start(options, &surface)?;
    let plasticity = law.plasticity.map(|name| name.plasticity()).unwrap_or_default();
    let soil = Soil::new(T::of(DENSITY), elasticity, surface)?.with_plasticity(plasticity);
    let driver = Driver::new(soil, start);
    match kind(options.path) {
        Some(kind) => follow(driver, kind, options),
        None => own::follow(driver, options),
    }
}

/// Along a named path: how far it has gone, and what the law answered.
fn follow<T: Real, M: Material<T>>(
    mut driver: Driver<T, M>,
    kind: Kind,
    options: &DriveOptions,
) -> Result<Answer, Failure> {
    let (amount, cycles) = way(options, kind)?;
    let path = Path::new(kind, T::of(amount)).cyclic(cycles);
    let steps = options.way.steps as usize;
    let rows =
        driver.run(&path, steps).map_err(|error| Failure::Numerical(format!("{}: {error}", kind.name())))?;
    Ok(Answer::of(amounts(amount, cycles, steps), &rows))
}

/// The stress at the start, which has to be admissible.
fn start<T: Real>(options: &DriveOptions, surface: &impl YieldSurface<T>) -> Result<SoilMemory<T>, Failure> {
    let stress = match &options.way.start_stress {
        None => SymTensor::isotropic(T::of(-options.way.confining_stress.unwrap_or(CONFINING_STRESS))),
        Some(six) => {
            let six: [f64; 6] = six.as_slice().try_into().map_err(|_| {
                let count = six.len();
                Failure::Usage(format!("--start-stress has {count} numbers, but a stress has six"))
            })?;
            SymTensor(six.map(T::of))
        }
    };
    if !stress.0.iter().all(|x| x.is_finite()) {
        return Err(Failure::Usage("the stress at the start is not finite".to_owned()));
    }
    let excess = surface.excess(&stress);
    let rounding = T::of(1e3) * T::EPSILON * (stress.root_j2() + stress.trace().abs());
    if excess > rounding {
        let what =
            format!("the stress at the start lies outside of the yield surface, by F = {excess:.6e} Pa");
        return Err(Failure::Usage(what));
    }
    Ok(SoilMemory::stressed(stress))
}

/// The library's path of this name; none if it is an own one.
fn kind(path: PathName) -> Option<Kind> {
    Some(match path {
        PathName::Oedometer => Kind::Oedometer,
        PathName::TriaxialCompression => Kind::TriaxialCompression,
        PathName::TriaxialExtension => Kind::TriaxialExtension,
        PathName::SimpleShear | PathName::Cyclic => Kind::SimpleShear,
        PathName::PureShear => Kind::PureShear,
        PathName::Isotropic => Kind::Isotropic,
        PathName::Rotation => Kind::Rotation,
        PathName::Own => return None,
    })
}

/// How far the path goes one way, and how often.
fn way(options: &DriveOptions, kind: Kind) -> Result<(f64, usize), Failure> {
    let way = &options.way;
    if way.legs.is_some() {
        return Err(Failure::Usage("--legs has a meaning on the path own only".to_owned()));
    }
    let amount = match (kind, way.strain, way.angle) {
        (Kind::Rotation, Some(_), _) => {
            return Err(Failure::Usage(
                "--strain has no meaning on the path rotation: give --angle".to_owned(),
            ));
        }
        (Kind::Rotation, None, angle) => angle.unwrap_or(ANGLE).to_radians(),
        (_, _, Some(_)) => {
            return Err(Failure::Usage("--angle has a meaning on the path rotation only".to_owned()));
        }
        (_, strain, None) => strain.unwrap_or(STRAIN),
    };
    if !(amount.is_finite() && amount != 0.0) {
        return Err(Failure::Usage(format!(
            "a path of {amount} leads nowhere: it must be finite, and not 0"
        )));
    }
    let once = u32::from(options.path == PathName::Cyclic);
    let cycles = way.cycles.unwrap_or(once);
    if cycles < once {
        return Err(Failure::Usage("the path cyclic has at least one cycle".to_owned()));
    }
    Ok((amount, cycles as usize))
}

/// How far the path has gone at each row.
fn amounts(amount: f64, cycles: usize, steps: usize) -> Vec<f64> {
    let corners: Vec<f64> = match cycles {
        0 => vec![0.0, amount],
        _ => core::iter::once(0.0).chain((0..cycles).flat_map(|_| [amount, -amount, 0.0])).collect(),
    };
    let between = |pair: &[f64]| {
        let (from, to) = (pair[0], pair[1]);
        (1..=steps).map(move |k| from + (to - from) * k as f64 / steps as f64)
    };
    core::iter::once(0.0).chain(corners.windows(2).flat_map(between)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cycle_goes_there_and_back() {
        assert_eq!(amounts(2.0, 0, 2), [0.0, 1.0, 2.0]);
        assert_eq!(amounts(2.0, 1, 2), [0.0, 1.0, 2.0, 0.0, -2.0, -1.0, 0.0]);
    }
}
