//! What is added from outside, verified in three lines each; and what the studies say of wrong ones.

use super::drag_law::Mat;
use super::integrator::{Euler, Heun};
use super::jelly::Jelly;
use super::kernel::Lucy;
use super::law::{Hooke, Remembering};
use super::search::Sweep;
use alluvium::material::Water;
use alluvium::time::{Evolve, Integrator, Moment};
use alluvium::verify::{self, Broken, Study, ready};

const HOOKE: Hooke = Hooke { density: 1000.0, sound_speed: 25.0 };
const MAT: Mat = Mat { viscous: 200.0, inertial: 4e3 };
const JELLY: Jelly = Jelly { density: 1000.0, sound_speed: 20.0, shear: 3e4, turns: 1.0 };

#[test]
fn the_kernel_is_one() -> Result<(), Broken> {
    verify::all(ready::kernel::<f64, 2, _>("Lucy, 2D", Lucy::new(0.013, 2)))?;
    verify::all(ready::kernel::<f64, 3, _>("Lucy, 3D", Lucy::new(0.013, 3)))?;
    verify::all(ready::kernel::<f32, 2, _>("Lucy, 2D, single", Lucy::new(0.013, 2)))
}

#[test]
fn the_laws_are_laws() -> Result<(), Broken> {
    verify::all(ready::law("Hooke", HOOKE))?;
    verify::all(ready::law("remembering", Remembering(Water::new(1000.0, 10.0).unwrap())))?;
    verify::all(ready::law("jelly", JELLY))
}

#[test]
fn the_search_finds_them_all() -> Result<(), Broken> {
    verify::all(ready::search::<f64, 2>("sweep, 2D", || Box::new(Sweep::new())))?;
    verify::all(ready::search::<f32, 3>("sweep, 3D", || Box::new(Sweep::new())))
}

#[test]
fn the_integrator_is_of_second_order() -> Result<(), Broken> {
    verify::all(ready::integrator::<f64, _>("Heun", || Heun))
}

#[test]
fn the_drag_is_drag() -> Result<(), Broken> {
    verify::all(ready::drag::<f64, _>("mat", MAT))
}

/// Every mutant of the studies is noticed with what is added here, too.
#[test]
fn the_studies_can_fail() {
    let mut studies = ready::kernel::<f64, 2, _>("Lucy", Lucy::new(0.013, 2));
    studies.extend(ready::law("jelly", JELLY));
    studies.extend(ready::search::<f64, 2>("sweep", || Box::new(Sweep::new())));
    studies.extend(ready::integrator::<f64, _>("Heun", || Heun));
    studies.extend(ready::drag::<f64, _>("mat", MAT));
    for study in &studies {
        for mutant in &study.mutants {
            let outcome = study.run_mutant(mutant);
            assert!(outcome.caught(), "{}, {mutant}: {}", study.name, outcome.sentence);
        }
    }
}

/// What is said of studies that must not pass.
fn verdict(studies: Vec<Study>) -> String {
    verify::all(studies).expect_err("something is wrong").to_string()
}

#[test]
fn a_constant_off_by_a_millionth_is_told() {
    let mut kernel = Lucy::<f64>::new(0.013, 2);
    kernel.height *= 1.0 + 1e-6;
    let said = verdict(ready::kernel::<f64, 2, _>("Lucy", kernel));
    let whole = "1 of 5 claims broke\nLucy/integral: the integral of the kernel over space is one: \
                 largest magnitude 1.000e-6; expected at most 1e-12";
    assert_eq!(said, whole);
}

#[test]
fn a_spin_of_the_wrong_sign_is_told() {
    let said = verdict(ready::law("jelly", Jelly { turns: -1.0, ..JELLY }));
    assert!(said.starts_with("1 of 8 claims broke\njelly/objectivity: stress turns with matter"), "{said}");
    assert!(said.contains("° in ") && said.ends_with("expected at most 1e-11"), "{said}");
}

#[test]
fn a_search_one_percent_short_is_told() {
    let short = ready::search::<f64, 2>("sweep", || Box::new(Sweep::reaching(0.99)));
    let said = verdict(short);
    assert!(
        said.contains("sweep/pairs: with it every point has the neighbours that brute force finds"),
        "{said}"
    );
    assert!(said.contains(" differences (lattice); expected none"), "{said}");
}

/// Velocity-Verlet that evaluates its second rates with the fields of the first.
#[derive(Clone, Debug)]
struct Unpredicted;

impl Integrator<f64> for Unpredicted {
    fn name(&self) -> &'static str {
        "unpredicted"
    }
    fn step<S: Evolve<f64>>(&mut self, system: &mut S, dt: f64) -> Result<(), S::Error> {
        system.evaluate()?;
        system.complete(Moment::Now, 0.5 * dt)?;
        system.advance(Moment::Half, Moment::Now, 0.5 * dt);
        system.drift(Moment::Half, dt);
        system.evaluate()?;
        system.complete(Moment::Half, 0.5 * dt)?;
        system.advance(Moment::Now, Moment::Half, 0.5 * dt);
        Ok(())
    }
}

#[test]
fn integrators_of_first_order_are_told() {
    let said = verdict(ready::integrator::<f64, _>("unpredicted", || Unpredicted));
    assert!(said.starts_with("3 of 5 claims broke\nunpredicted/equal steps: of second order"), "{said}");
    assert!(said.contains("order 1.0") && said.contains("expected an order of at least 1.9"), "{said}");
    let said = verdict(ready::integrator::<f64, _>("Euler", || Euler));
    assert!(said.starts_with("4 of 5 claims broke\nEuler/undamped"), "{said}");
}

#[test]
fn drag_that_drives_is_told() {
    let said = verdict(ready::drag::<f64, _>("mat", Mat { viscous: -1.0, ..MAT }));
    assert!(said.contains("mat/sign: the coefficient is finite and not negative"), "{said}");
}

#[test]
fn no_study_is_no_proof() {
    assert_eq!(verdict(Vec::new()), "there was no study");
}
