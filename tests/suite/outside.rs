//! What another crate can add through the public interface alone: a kernel, a search, an integrator,
//! a law, a yield surface and a law of drag, each checked for what it has to do, most of it by ready-made studies.
//! `docs/extending.md` tells the same as recipes.

#[cfg(feature = "verify")]
mod drag_law;
mod integrator;
#[cfg(feature = "verify")]
mod jelly;
mod kernel;
mod law;
mod search;
#[cfg(feature = "verify")]
mod verified;
mod yield_surface;
