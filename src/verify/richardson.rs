//! Richardson extrapolation and the grid convergence index (Roache 1994), for when no exact
//! solution is known.

/// What three solutions at spacings `s`, `r s`, `r² s` tell about the limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Richardson {
    /// Observed order `p = ln(|f₃ − f₂| / |f₂ − f₁|) / ln r`, f₁ the finest.
    pub observed_order: f64,
    /// The order used: the observed one, or the formal one where that is not credible.
    pub order: f64,
    /// Whether the observed order was discarded: outside \[0.5, formal + 0.5\], or an oscillation.
    pub fallback: bool,
    /// The limit, `f₁ + (f₁ − f₂)/(rᵖ − 1)`.
    pub extrapolated: f64,
    /// `GCI₂₁ = Fₛ |(f₁ − f₂)/f₁| / (rᵖ − 1)`: a relative error band of the finest solution;
    /// `Fₛ = 1.25`, or 3 after a fallback.
    pub gci_fine: f64,
    /// `GCI₃₂`, that of the middle one.
    pub gci_coarse: f64,
    /// `GCI₃₂ / (rᵖ GCI₂₁)`: near one in the asymptotic range.
    pub asymptotic_ratio: f64,
}

impl Richardson {
    /// From `[f₁, f₂, f₃]`, finest first, each `ratio` times coarser than the one before.
    pub fn new(finest_first: [f64; 3], ratio: f64, formal_order: f64) -> Self {
        let [f1, f2, f3] = finest_first;
        let observed_order = ((f3 - f2).abs() / (f2 - f1).abs()).ln() / ratio.ln();
        let monotone = (f3 - f2) * (f2 - f1) > 0.0;
        let credible = monotone && (0.5..=formal_order + 0.5).contains(&observed_order);
        let (order, safety) = if credible { (observed_order, 1.25) } else { (formal_order, 3.0) };
        let growth = ratio.powf(order);
        let gci_fine = gci(safety, f1, f2, growth);
        let gci_coarse = gci(safety, f2, f3, growth);
        Self {
            observed_order,
            order,
            fallback: !credible,
            extrapolated: f1 + (f1 - f2) / (growth - 1.0),
            gci_fine,
            gci_coarse,
            asymptotic_ratio: gci_coarse / (growth * gci_fine),
        }
    }

    /// Whether the solutions lie in the asymptotic range: a credible order, and a ratio in
    /// \[0.9, 1.1\].
    pub fn is_asymptotic(&self) -> bool {
        !self.fallback && (0.9..=1.1).contains(&self.asymptotic_ratio)
    }
}

/// The index from two solutions only, with the formal order and `Fₛ = 3`.
pub fn gci_of_two(fine: f64, coarse: f64, ratio: f64, formal_order: f64) -> f64 {
    gci(3.0, fine, coarse, ratio.powf(formal_order))
}

fn gci(safety: f64, fine: f64, coarse: f64, growth: f64) -> f64 {
    safety * ((fine - coarse) / fine).abs() / (growth - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(a: f64, b: f64, tolerance: f64) -> bool {
        (a - b).abs() <= tolerance
    }

    #[test]
    fn a_power_law_is_extrapolated_to_its_limit() {
        let f = |s: f64| 3.0 + 0.5 * s.powf(1.8);
        let r = Richardson::new([f(0.1), f(0.15), f(0.225)], 1.5, 2.0);
        assert!(near(r.observed_order, 1.8, 1e-11) && !r.fallback);
        assert!(near(r.extrapolated, 3.0, 1e-12));
        // The index is 1.25 times the relative error it bounds.
        assert!(near(r.gci_fine, 1.25 * (f(0.1) - 3.0) / f(0.1), 1e-13));
        assert!(r.is_asymptotic());
    }

    #[test]
    fn the_published_example_of_the_method_is_reproduced() {
        // NASA's tutorial (Slater): pressure recovery .970500, .968540, .961780 on grids 1, 2, 4.
        let r = Richardson::new([0.970_500, 0.968_540, 0.961_780], 2.0, 2.0);
        assert!(near(r.observed_order, 1.786_170, 1e-6));
        assert!(near(r.extrapolated, 0.971_300, 1e-6));
        assert!(near(r.gci_fine, 0.001_031, 1e-6) && near(r.gci_coarse, 0.003_562, 1e-6));
        assert!(near(r.asymptotic_ratio, 1.002, 1e-3));
    }

    #[test]
    fn an_incredible_order_is_not_used() {
        let flat = Richardson::new([1.0, 1.1, 1.21], 2.0, 2.0);
        assert!(flat.fallback && flat.order == 2.0 && !flat.is_asymptotic());
        let oscillating = Richardson::new([1.0, 1.1, 0.7], 2.0, 2.0);
        assert!(oscillating.fallback && near(oscillating.observed_order, 2.0, 1e-9));
        assert!(near(oscillating.gci_fine, gci_of_two(1.0, 1.1, 2.0, 2.0), 1e-15));
        assert!(Richardson::new([1.0, 1.0, 1.0], 2.0, 2.0).fallback);
    }
}
