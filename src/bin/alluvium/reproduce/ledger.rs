//! Where a run's energy is, from its history.

use crate::plots::{Chart, Series};
use crate::solver::quantity;
use alluvium::output::{Table, TableError};

/// Stored energies and what terms have taken, over time.
pub struct Ledger {
    time: Vec<f64>,
    /// Names and energies, stored first, then what terms took.
    energies: Vec<(String, Vec<f64>)>,
    /// Energy no account explains, over the potential energy at the start.
    pub closure: Vec<f64>,
}

impl Ledger {
    /// From `history.csv`.
    pub fn read(history: &Table) -> Result<Self, TableError> {
        let first = [quantity::POTENTIAL, quantity::KINETIC];
        let columns = || history.columns().iter().map(String::as_str);
        let stored = columns().filter(|name| name.ends_with("_energy [J]") && !first.contains(name));
        let taken = columns().filter(|name| name.starts_with(quantity::TAKEN));
        let energies = first.into_iter().chain(stored).chain(taken);
        let energies = energies.map(|name| Ok((readable(name), history.column(name)?)));
        let whole = history.column(quantity::POTENTIAL)?.first().copied().unwrap_or(1.0);
        Ok(Self {
            time: history.column("time [s]")?,
            energies: energies.collect::<Result<_, _>>()?,
            closure: history.column(quantity::CLOSURE)?.into_iter().map(|x| x / whole).collect(),
        })
    }

    /// Stored and taken energy, stacked: the top edge is level if all is accounted for.
    pub fn svg(&self, title: &str) -> String {
        let whole: f64 = self.energies.iter().filter_map(|(_, e)| e.first()).sum();
        // As many points as there are pixels in the width of two.
        let every = (self.time.len() / 250).max(1);
        let shares = |e: &Vec<f64>| e.iter().step_by(every).map(|e| e / whole).collect::<Vec<_>>();
        let time: Vec<f64> = self.time.iter().step_by(every).copied().collect();
        // What never holds a five-hundredth cannot be seen.
        let seen = |e: &Vec<f64>| e.iter().any(|e| e.abs() > 2e-3 * whole);
        let energies = self.energies.iter().filter(|(_, e)| seen(e));
        let parts: Vec<_> = energies.map(|(name, e)| (name.as_str(), shares(e))).collect();
        Chart::new(title, "time [s]", "energy / energy at the start")
            .x_range(0.0, self.time.last().copied().unwrap_or(1.0))
            .y_range(0.0, 1.05)
            .with_all(Series::stack(&time, &parts))
            .svg()
    }
}

/// `taken_by_artificial_viscosity [J]` as words for a legend.
fn readable(column: &str) -> String {
    let name = column.split(" [").next().unwrap_or(column);
    name.replace(quantity::TAKEN, "taken by ").replace('_', " ").replace(" energy", "")
}
