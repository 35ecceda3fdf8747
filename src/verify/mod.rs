//! Verification as values: studies with an expectation, the tools to judge them, and reports.
//!
//! A [`Study`] claims something, measures it, and says beforehand what has to come out: an order, a
//! value, a bound, a plateau. It also names mutants: deliberate mistakes under which it must fail,
//! so that a study which cannot fail is found out. For a kernel, a law, a search, an integrator
//! or a law of drag of your own there are studies [`ready`] made, to be run with [`all`].
//!
//! ```
//! use alluvium::verify::{Conditions, Expected, Measured, Study, observed_order};
//! let study = Study::new("trapezoid", "the trapezoidal rule is of second order", |conditions| {
//!     let ends = if conditions.is("ends count twice") { 2.0 } else { 1.0 };
//!     let error = |n: u32| {
//!         let h = 1.0 / f64::from(n);
//!         let inner: f64 = (1..n).map(|k| (f64::from(k) * h).exp()).sum();
//!         let sum = h * (inner + ends * 0.5 * (1.0 + 1.0_f64.exp()));
//!         (h, (sum - (1.0_f64.exp() - 1.0)).abs())
//!     };
//!     Measured::errors([8, 16, 32].map(error))
//! })
//! .expect(Expected::order(2.0, 0.1))
//! .mutant("ends count twice");
//! assert!(study.run().passed());
//! assert!(study.run_mutant("ends count twice").caught());
//! ```

mod arrangement;
mod broken;
pub mod consolidation;
mod curve;
pub mod dam_break;
mod environment;
mod expected;
mod flawed;
pub mod jet;
mod json;
pub mod manufactured;
mod norms;
mod order;
mod parcel;
pub mod plot;
mod quadrature;
pub mod ready;
mod report;
mod richardson;
pub mod sand_column;
mod study;
pub mod u_tube;

pub use arrangement::{Arrangement, Random};
pub use broken::{Broken, all};
pub use curve::Curve;
pub use environment::Environment;
pub use expected::{Expected, Measured, Point, Table};
pub use flawed::{Flawed, ShortSighted};
pub use norms::{l_infinity, relative_l2};
pub use order::{OrderFit, fit_order, observed_order, observed_orders};
pub use parcel::Parcel;
pub use quadrature::integrate;
pub use report::Report;
pub use richardson::{Richardson, gci_of_two};
pub use study::{Conditions, Level, Outcome, Shortfall, Standing, Study};
