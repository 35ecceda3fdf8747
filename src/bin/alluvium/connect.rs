//! From a case to a simulation of it: the one place where precision, dimension, kernel and integrator
//! become types. Each combination is compiled on its own, which takes its time: the program offers two of
//! the library's kernels.

use crate::outcome::Failure;
use crate::simulated::Simulated;
use crate::solver::Solver;
use alluvium::Real;
use alluvium::case::{BuildError, Case, IntegratorChoice, KernelChoice, Precision};
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
    Failure::NotInThisBuild(format!(
        "particles.kernel = \"{kernel}\": the program offers \"wendland-c2\" and \"wendland-c4\", the \
         others are the library's alone"
    ))
}

fn kernel<T: Real + Component, const D: usize>(case: &Case) -> Connected {
    let h = T::of(case.smoothing_length());
    match case.particles.kernel {
        KernelChoice::WendlandC2 => integrator::<T, D, _>(case, WendlandC2::new(h).map_err(refused)?),
        KernelChoice::WendlandC4 => integrator::<T, D, _>(case, WendlandC4::new(h).map_err(refused)?),
        other => Err(not_offered(other)),
    }
}

fn integrator<T: Real + Component, const D: usize, K: Kernel<T, D>>(case: &Case, kernel: K) -> Connected {
    match case.time.integrator {
        IntegratorChoice::LeapFrog => simulated(case, kernel, LeapFrog::new()),
        IntegratorChoice::VelocityVerlet => simulated(case, kernel, VelocityVerlet::new()),
    }
}

fn simulated<T: Real + Component, const D: usize, K: Kernel<T, D>>(
    case: &Case,
    kernel: K,
    integrator: impl Integrator<T>,
) -> Connected {
    let simulation = case.simulation::<T, D, K, _>(kernel, integrator).map_err(refused)?;
    Ok(Box::new(Simulated::new(simulation, case)))
}

fn refused(error: impl Into<BuildError>) -> Failure {
    Failure::NotInThisBuild(error.into().to_string())
}
