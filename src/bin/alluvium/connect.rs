//! From a case to a simulation of it: the one place where precision, dimension, kernel and integrator
//! become types. Each combination is compiled on its own, which takes its time: the program offers two of
//! the library's kernels.

use crate::outcome::Failure;
use crate::simulated::Simulated;
use crate::solver::Solver;
use alluvium::Real;
use alluvium::case::{BuildError, Case, IntegratorChoice, KernelChoice, Objection, Precision};
use alluvium::kernel::{Kernel, WendlandC2, WendlandC4};
use alluvium::output::Component;
use alluvium::time::{Integrator, LeapFrog, VelocityVerlet};

type Connected = Result<Box<dyn Solver + Send>, Failure>;

/// The simulation of a case, in its precision and dimension.
pub fn connect(case: &Case) -> Connected {
    match (case.precision, case.dimension) {
        (Precision::F64, 2) => kernel::<f64, 2>(case),
        (Precision::F64, _) => kernel::<f64, 3>(case),
        (Precision::F32, 2) => kernel::<f32, 2>(case),
        (Precision::F32, _) => kernel::<f32, 3>(case),
    }
}

/// Whether this build can simulate a case.
pub fn offers(case: &Case) -> Result<(), Failure> {
    match case.particles.kernel {
        KernelChoice::WendlandC2 | KernelChoice::WendlandC4 => Ok(()),
        other => Err(not_offered(other)),
    }
}

fn not_offered(kernel: KernelChoice) -> Failure {
    objection(
        "particles.kernel",
        format!("is the library's alone: the program was compiled without \"{kernel}\""),
        "\"wendland-c2\", \"wendland-c4\"".to_owned(),
    )
}

fn kernel<T: Real + Component, const D: usize>(case: &Case) -> Connected {
    let h = T::of(case.smoothing_length());
    match case.particles.kernel {
        KernelChoice::WendlandC2 => integrator::<T, D, _>(case, WendlandC2::new(h).map_err(unbuilt(case))?),
        KernelChoice::WendlandC4 => integrator::<T, D, _>(case, WendlandC4::new(h).map_err(unbuilt(case))?),
        other => Err(not_offered(other)),
    }
}

fn integrator<T: Real + Component, const D: usize, K: Kernel<T, D>>(case: &Case, kernel: K) -> Connected {
    match case.time.integrator {
        IntegratorChoice::LeapFrog => simulated(case, kernel, LeapFrog::new()),
        IntegratorChoice::LeapFrogAb3 => simulated(case, kernel, LeapFrog::new().with_third_order_density()),
        IntegratorChoice::VelocityVerlet => simulated(case, kernel, VelocityVerlet::new()),
    }
}

fn simulated<T: Real + Component, const D: usize, K: Kernel<T, D>>(
    case: &Case,
    kernel: K,
    integrator: impl Integrator<T>,
) -> Connected {
    let simulation = case.simulation::<T, D, K, _>(kernel, integrator).map_err(unbuilt(case))?;
    Ok(Box::new(Simulated::new(simulation, case)))
}

/// What is left for the library to refuse: a value that rounds to none in single precision, a part that is
/// not in this build.
fn unbuilt<E: Into<BuildError>>(case: &Case) -> impl Fn(E) -> Failure {
    let precision = case.precision;
    move |error| match error.into() {
        BuildError::Parameter(error) => {
            let why = format!("makes {} = {} of the case's value", error.name, error.value);
            let allowed = if precision == Precision::F32 { "; or precision = \"f64\"" } else { "" };
            objection("precision", why, format!("{}{allowed}", error.allowed))
        }
        BuildError::Search(search) => objection(
            "neighbours.search",
            format!("is not in this build: no \"{search}\""),
            "another search".to_owned(),
        ),
        error => objection("name", format!("cannot be run: {error}"), "another build".to_owned()),
    }
}

fn objection(key: &str, why: String, allowed: String) -> Failure {
    Failure::Refused(Objection { key: key.to_owned(), why, allowed })
}
