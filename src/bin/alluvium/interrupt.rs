//! Ctrl-C and SIGTERM: the first asks the run to stop after its step, the second stops the program at once.
//! SIGHUP is left as it is, for `nohup`.

use crate::screen;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::io;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, LazyLock, Once};

/// What ends a run, with the exit code a shell gives to it.
const SIGNALS: [(i32, u8); 2] = [(SIGINT, 130), (SIGTERM, 143)];

/// Whether one has come.
static CAME: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);
/// The exit code of the one that came; 0 before.
static CODE: LazyLock<Arc<AtomicUsize>> = LazyLock::new(Arc::default);
static LISTEN: Once = Once::new();

/// Listens from now on.
pub fn listen() {
    LISTEN.call_once(|| {
        if let Err(error) = SIGNALS.into_iter().try_for_each(|(signal, code)| heed(signal, code)) {
            screen::say(format_args!("warning: ctrl-C will not write the last state: {error}"));
        }
    });
}

/// What is registered first acts first: one signal alone does not yet find that it came.
fn heed(signal: i32, code: u8) -> io::Result<()> {
    flag::register_conditional_shutdown(signal, code.into(), Arc::clone(&CAME))?;
    flag::register_usize(signal, Arc::clone(&CODE), code.into())?;
    flag::register(signal, Arc::clone(&CAME))?;
    Ok(())
}

/// The exit code, if the run should stop.
pub fn asked() -> Option<u8> {
    u8::try_from(CODE.load(Ordering::Relaxed)).ok().filter(|code| *code != 0)
}
