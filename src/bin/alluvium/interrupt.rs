//! Ctrl-C: the first asks the run to stop after its step, the second stops the program at once.

use crate::screen;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

static ASKED: AtomicBool = AtomicBool::new(false);
static LISTEN: Once = Once::new();

/// Listens from now on.
pub fn listen() {
    LISTEN.call_once(|| {
        let listening = ctrlc::set_handler(|| {
            if ASKED.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
        });
        if let Err(error) = listening {
            screen::say(format_args!("warning: ctrl-C will not write the last state: {error}"));
        }
    });
}

/// Whether the run should stop.
pub fn asked() -> bool {
    ASKED.load(Ordering::Relaxed)
}
