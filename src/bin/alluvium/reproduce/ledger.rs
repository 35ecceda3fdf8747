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
        let columns = || history.columns().iter().map(|head| quantity::name(head));
        let stored = columns().filter(|name| name.ends_with("_energy") && !first.contains(name));
        let taken = columns().filter(|name| name.starts_with(quantity::TAKEN));
        let energies = first.into_iter().chain(stored).chain(taken);
        let energies = energies.map(|name| Ok((readable(name), quantity::column(history, name)?)));
        let whole = quantity::column(history, quantity::POTENTIAL)?.first().copied().unwrap_or(1.0);
        Ok(Self {
            time: history.column("time [s]")?,
            energies: energies.collect::<Result<_, _>>()?,
            closure: quantity::column(history, quantity::CLOSURE)?.into_iter().map(|x| x / whole).collect(),
        })
    }

    /// Stored and taken energy, stacked; what terms gave lies below zero, and lifts the top edge, which is
    /// level otherwise if all is accounted for.
    pub fn svg(&self, title: &str) -> String {
        let whole: f64 = self.energies.iter().filter_map(|(_, e)| e.first()).sum();
        // As many points as there are pixels in the width of two.
        let every = (self.time.len() / 250).max(1);
        let time: Vec<f64> = self.time.iter().step_by(every).copied().collect();
        let parts = |sign: f64| -> Vec<(String, Vec<f64>)> {
            let share = |e: &f64| sign * (sign * e / whole).max(0.0);
            let shares = |e: &Vec<f64>| e.iter().step_by(every).map(share).collect::<Vec<_>>();
            // What never holds a five-hundredth cannot be seen.
            let seen = |e: &Vec<f64>| e.iter().any(|e| e.abs() > 2e-3);
            let named = self.energies.iter().map(|(name, e)| (name.clone(), shares(e)));
            named.filter(|(_, e)| seen(e)).collect()
        };
        let (held, given) = (parts(1.0), parts(-1.0));
        let given = given.into_iter().map(|(name, e)| (name.replace("taken by", "given by"), e));
        let given: Vec<_> = given.collect();
        let lowest = given.iter().map(|(_, e)| e.iter().copied().fold(0.0, f64::min)).sum::<f64>();
        let stack = |parts: &[(String, Vec<f64>)]| {
            let parts: Vec<_> = parts.iter().map(|(name, e)| (name.as_str(), e.clone())).collect();
            Series::stack(&time, &parts)
        };
        Chart::new(title, "time [s]", "energy / energy at the start")
            .x_range(0.0, self.time.last().copied().unwrap_or(1.0))
            .y_range(1.2 * lowest, 1.05 - lowest)
            .with_all(stack(&held))
            .with_all(stack(&given))
            .svg()
    }
}

/// `taken_by_artificial_viscosity` as words for a legend.
fn readable(name: &str) -> String {
    name.replace(quantity::TAKEN, "taken by ").replace('_', " ").replace(" energy", "")
}
