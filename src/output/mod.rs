//! Files a run leaves behind: particles for ParaView ([`Vtp`], [`Pvd`]) and tables ([`TableWriter`],
//! [`Table`]). Plain data in, files out; every file is either whole or not there.

mod atomic;
mod pvd;
mod table;
mod vtp;

pub use atomic::write_whole;
pub use pvd::Pvd;
pub use table::{Cell, Table, TableError, TableWriter};
pub use vtp::{Component, LengthError, Vtp};
