//! Words a case file may choose from.

use crate::material::{Cone, Plasticity};
use crate::mixture::{CouplingForm, VolumeFraction};
use crate::preset::Preset;

/// An enumeration whose variants are words in a case file.
pub trait Choice: Copy + PartialEq + 'static {
    /// Every variant, in the order they are listed in messages.
    const ALL: &'static [Self];
    /// The word in the file.
    fn word(self) -> &'static str;
}

macro_rules! choice {
    ($(#[$about:meta])* $name:ident { $( $(#[$doc:meta])* $variant:ident = $word:literal ),* $(,)? }) => {
        $(#[$about])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum $name { $( $(#[$doc])* $variant ),* }

        impl Choice for $name {
            const ALL: &'static [Self] = &[$(Self::$variant),*];
            fn word(self) -> &'static str {
                match self { $(Self::$variant => $word),* }
            }
        }

        impl core::fmt::Display for $name {
            fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
                f.write_str(self.word())
            }
        }
    };
}

impl Choice for Preset {
    const ALL: &'static [Self] = &[Self::Default, Self::Paper];
    fn word(self) -> &'static str {
        self.name()
    }
}

impl Choice for Cone {
    const ALL: &'static [Self] = &Self::ALL;
    fn word(self) -> &'static str {
        match self {
            Self::PlaneStrain => "plane-strain",
            Self::PlaneStrainAssociated => "plane-strain-associated",
            Self::PlaneStrainNonDilatant => "plane-strain-non-dilatant",
            Self::TriaxialCompression => "triaxial-compression",
            Self::TriaxialExtension => "triaxial-extension",
        }
    }
}

impl Choice for CouplingForm {
    const ALL: &'static [Self] = &[Self::PressureDifference, Self::Printed];
    fn word(self) -> &'static str {
        match self {
            Self::PressureDifference => "pressure-difference",
            Self::Printed => "printed",
        }
    }
}

impl Choice for VolumeFraction {
    const ALL: &'static [Self] = &[Self::Rate, Self::Sum];
    fn word(self) -> &'static str {
        match self {
            Self::Rate => "rate",
            Self::Sum => "sum",
        }
    }
}

impl Choice for Plasticity {
    const ALL: &'static [Self] = &[Self::ReturnMapping, Self::Rate, Self::LiteralRate];
    fn word(self) -> &'static str {
        match self {
            Self::ReturnMapping => "return-mapping",
            Self::Rate => "rate",
            Self::LiteralRate => "literal-rate",
        }
    }
}

choice! {
    /// The numbers the run is computed in.
    Precision {
        /// Single precision.
        F32 = "f32",
        /// Double precision.
        F64 = "f64",
    }
}
choice! {
    /// The smoothing kernel.
    KernelChoice {
        /// Wendland C2, the paper's (43).
        WendlandC2 = "wendland-c2",
        /// Wendland C4.
        WendlandC4 = "wendland-c4",
        /// Wendland C6.
        WendlandC6 = "wendland-c6",
        /// Cubic B-spline.
        CubicSpline = "cubic-spline",
        /// Quintic B-spline.
        QuinticSpline = "quintic-spline",
    }
}
choice! {
    /// A component of strain or stress.
    Component {
        /// Normal, along x.
        Xx = "xx",
        /// Normal, along y.
        Yy = "yy",
        /// Normal, along z.
        Zz = "zz",
        /// Shear in the plane of x and y.
        Xy = "xy",
        /// Shear in the plane of y and z.
        Yz = "yz",
        /// Shear in the plane of x and z.
        Xz = "xz",
    }
}
choice! {
    /// How soil and water drag each other.
    DragKind {
        /// Not at all.
        None = "none",
        /// By Darcy's law (37).
        Darcy = "darcy",
        /// With a conductivity that follows the porosity.
        KozenyCarman = "kozeny-carman",
        /// As Ergun's bed of grains.
        Ergun = "ergun",
        /// By Darcy's law with inertia.
        Forchheimer = "forchheimer",
    }
}
choice! {
    /// How drag goes through a time step.
    SchemeChoice {
        /// Evaluated where the step bears it, else solved.
        Automatic = "automatic",
        /// Evaluated like any force.
        Explicit = "explicit",
        /// Solved over the step, by backward Euler.
        BackwardEuler = "backward-euler",
        /// Solved over the step, by SDIRK2.
        SecondOrder = "second-order",
    }
}
choice! {
    /// What the density diffusion (δ-term) acts on.
    DiffusionKind {
        /// No density diffusion.
        None = "none",
        /// Partial density, as printed (52), (54).
        PartialDensity = "partial-density",
        /// True density.
        TrueDensity = "true-density",
        /// True density less its hydrostatic part.
        Hydrostatic = "hydrostatic",
        /// True density with renormalised gradients (Antuono et al. 2010).
        Renormalised = "renormalised",
    }
}
choice! {
    /// The pressure a block of water starts with.
    InitialPressure {
        /// Of water at rest under its surface (74).
        Hydrostatic = "hydrostatic",
        /// None.
        Zero = "zero",
    }
}
choice! {
    /// Where the elasticity of soil ends.
    SurfaceKind {
        /// A circular cone (27).
        DruckerPrager = "drucker-prager",
        /// The pyramid of Mohr and Coulomb.
        MohrCoulomb = "mohr-coulomb",
        /// Nowhere.
        Elastic = "elastic",
    }
}
choice! {
    /// The stress a body of soil starts with.
    InitialStress {
        /// Of soil at rest under its surface (75).
        Geostatic = "geostatic",
        /// None.
        Zero = "zero",
    }
}
choice! {
    /// How walls are made.
    WallKind {
        /// Dynamic particles, the paper's: they feel and evolve but do not move.
        Dynamic = "dynamic",
        /// Pressure and velocity extrapolated from the water (Adami et al. 2012).
        Extrapolated = "extrapolated",
    }
}
choice! {
    /// What soil or water does along a wall.
    SlipChoice {
        /// It sticks.
        NoSlip = "no-slip",
        /// It slides.
        FreeSlip = "free-slip",
        /// It sticks until the wall's friction gives way: soil alone.
        Friction = "friction",
    }
}
choice! {
    /// A side of the tank.
    Side {
        /// Low x.
        LowX = "-x",
        /// High x.
        HighX = "+x",
        /// Low y.
        LowY = "-y",
        /// High y.
        HighY = "+y",
        /// Low z.
        LowZ = "-z",
        /// High z.
        HighZ = "+z",
    }
}
choice! {
    /// A direction.
    Axis {
        /// x
        X = "x",
        /// y
        Y = "y",
        /// z
        Z = "z",
    }
}
choice! {
    /// How time advances.
    IntegratorChoice {
        /// Leap-frog, (71)–(72).
        LeapFrog = "leap-frog",
        /// Leap-frog whose density is foretold as by Adams and Bashforth's method of third order.
        LeapFrogAb3 = "leap-frog-ab3",
        /// Velocity-Verlet, kick-drift-kick.
        VelocityVerlet = "velocity-verlet",
    }
}
choice! {
    /// How neighbours are found; the results are the same bit for bit.
    SearchChoice {
        /// Cells of one support.
        CellList = "cell-list",
        /// The kd-tree of kiddo.
        KdTree = "kd-tree",
        /// Every pair.
        BruteForce = "brute-force",
    }
}
choice! {
    /// An array in the particle files; position, `id` and `kind` are always there.
    Field {
        /// Velocity \[m/s\].
        Velocity = "velocity",
        /// Pressure \[Pa\], + in compression.
        Pressure = "pressure",
        /// True density \[kg/m³\].
        Density = "density",
        /// Mass \[kg\].
        Mass = "mass",
        /// Volume fraction \[–\].
        VolumeFraction = "volume_fraction",
        /// Partial density \[kg/m³\].
        PartialDensity = "partial_density",
        /// Stress of soil \[Pa\], + in tension.
        Stress = "stress",
        /// Plastic strain of soil \[–\], + in extension.
        PlasticStrain = "plastic_strain",
        /// Equivalent plastic strain of soil \[–\].
        EquivalentPlasticStrain = "equivalent_plastic_strain",
    }
}
choice! {
    /// What a gauge measures.
    Quantity {
        /// Pressure \[Pa\].
        Pressure = "pressure",
        /// Velocity \[m/s\].
        Velocity = "velocity",
        /// Level of the surface above the gauge's foot point \[m\].
        SurfaceElevation = "surface-elevation",
    }
}

impl Side {
    /// The side's axis: 0, 1 or 2.
    pub fn axis(self) -> usize {
        self as usize / 2
    }
    /// Whether it is the high side.
    pub fn is_high(self) -> bool {
        self as usize % 2 == 1
    }
}

impl KernelChoice {
    /// Support radius in smoothing lengths, κ.
    pub fn support_ratio(self) -> f64 {
        match self {
            Self::QuinticSpline => 3.0,
            _ => 2.0,
        }
    }
}

impl Field {
    /// Whether soil alone has it.
    pub fn is_of_soil(self) -> bool {
        matches!(self, Self::Stress | Self::PlasticStrain | Self::EquivalentPlasticStrain)
    }
}
