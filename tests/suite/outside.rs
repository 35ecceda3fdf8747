//! What another crate can add through the public interface alone: a kernel, a search, an integrator,
//! a law and a yield surface, each checked for what it has to do. `docs/extending.md` tells the same as recipes.

mod integrator;
mod kernel;
mod law;
mod search;
mod yield_surface;
