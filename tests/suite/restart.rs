//! A run resumed from a snapshot has the same bits as one that never stopped.

use crate::fingerprint::hash;
use crate::tank::Dam;
use alluvium::Real;
use alluvium::material::Absent;
use alluvium::mixture::{Slip, Wall};
use alluvium::simulation::Simulation;
use alluvium::time::{Integrator, LeapFrog, StepSize, VelocityVerlet};

const DAM: Dam = Dam { spacing: 0.005, ..Dam::SMALL };

fn run<T: Real, I: Integrator<T>>(
    wall: &Wall<T, 2>,
    integrator: I,
) -> Simulation<T, 2, Kernel<T>, Absent, Water<T>, I> {
    let step_size = StepSize::courant(T::of(0.2)).unwrap();
    Simulation::new(DAM.mixture(wall.clone()), integrator, step_size).with_reinitialisation(30)
}

type Kernel<T> = alluvium::kernel::WendlandC2<T, 2>;
type Water<T> = alluvium::material::Water<T>;

fn resumes<T: Real, I: Integrator<T>>(wall: &Wall<T, 2>, integrator: &I) {
    let mut whole = run(wall, integrator.clone());
    for _ in 0..250 {
        whole.step().unwrap();
    }
    let snapshot = whole.snapshot();
    for _ in 0..250 {
        whole.step().unwrap();
    }
    assert!(whole.mixture().water_neighbourhood().rebuilds() > 1, "the list was never renewed");
    let mut resumed = run(wall, integrator.clone());
    resumed.restore(snapshot.clone()).unwrap();
    assert_eq!((resumed.time(), resumed.steps()), (snapshot.time(), 250));
    for _ in 0..250 {
        resumed.step().unwrap();
    }
    assert_eq!(hash(resumed.mixture()), hash(whole.mixture()), "{} {}", T::NAME, integrator.name());
    assert_eq!(resumed.budget(), whole.budget());
}

#[test]
fn a_resumed_run_has_the_same_bits() {
    for wall in [Wall::dynamic(), Wall::extrapolated(Slip::FreeSlip)] {
        resumes::<f64, _>(&wall, &LeapFrog::new());
        resumes::<f64, _>(&wall, &LeapFrog::new().with_third_order_density());
        resumes::<f64, _>(&wall, &VelocityVerlet::new());
    }
    let sticky = Wall::extrapolated(Slip::NoSlip);
    resumes::<f32, _>(&sticky, &LeapFrog::new());
    resumes::<f32, _>(&sticky, &LeapFrog::new().with_third_order_density());
    resumes::<f32, _>(&sticky, &VelocityVerlet::new());
}

#[test]
fn a_snapshot_of_something_else_is_refused() {
    let snapshot = run::<f64, _>(&Wall::dynamic(), LeapFrog::new()).snapshot();
    let other = Dam { spacing: 0.01, ..Dam::SMALL }.mixture(Wall::dynamic());
    let mut other = Simulation::new(other, LeapFrog::new(), StepSize::courant(0.2).unwrap());
    let message = other.restore(snapshot).unwrap_err().to_string();
    assert!(message.contains("particles in the state"), "{message}");
}

#[cfg(feature = "serde")]
#[test]
fn a_snapshot_survives_being_written() {
    let mut original = run::<f64, _>(&Wall::dynamic(), LeapFrog::new());
    for _ in 0..20 {
        original.step().unwrap();
    }
    let snapshot = original.snapshot();
    let text = serde_json::to_string(&snapshot).unwrap();
    let read = serde_json::from_str(&text).unwrap();
    assert_eq!(snapshot, read);
}
