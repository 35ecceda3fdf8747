//! Bars with their numbers and a plain yes or no, as a table.

/// The table's rows.
#[derive(Default)]
pub struct Bars(Vec<String>);

impl Bars {
    /// One bar; `met` is none where nothing is asked.
    pub fn add(&mut self, what: &str, measured: impl AsRef<str>, bar: impl AsRef<str>, met: Option<bool>) {
        let verdict = match met {
            Some(true) => "yes",
            Some(false) => "**no**",
            None => "–",
        };
        self.0.push(format!("| {what} | {} | {} | {verdict} |", measured.as_ref(), bar.as_ref()));
    }

    /// The table.
    pub fn markdown(&self) -> String {
        "| what | computed | bar | met |\n|---|---|---|---|\n".to_owned() + &self.0.join("\n") + "\n"
    }
}
