//! Keys that an analysis does not use.

use crate::case::{Case, CaseKey, Diagnostic, KEYS, diagnosis};

impl Case {
    /// Keys that the case gives and that an analysis of a command does not use, each with the reason.
    pub fn ignored_by(&self, command: &str) -> Vec<Diagnostic> {
        let has = [("cycle", self.cycle.is_some()), ("basin", self.basin.is_some())];
        let analyses = has.into_iter().filter(|(analysis, is_here)| {
            *analysis == command || (*is_here && ["sweep", "convergence"].contains(&command))
        });
        let ignored = analyses.filter(|_| self.has_rotating_waves()).flat_map(|(analysis, _)| {
            let given = |key: &&CaseKey| {
                let item = self.raw.find(key.name);
                item.is_some_and(|item| !key.is_default(&item.value))
            };
            let keys = KEYS.iter().filter(|key| !key.of_waves.is_empty());
            keys.filter(given).map(move |key| (analysis, key))
        });
        let say = |(analysis, key): (&str, &CaseKey)| {
            let CaseKey { name, of_waves, .. } = key;
            diagnosis!(self, name, "{name} is not used by {analysis}: {of_waves}"; "not used")
        };
        let mut said: Vec<Diagnostic> = ignored.map(say).collect();
        said.extend(self.ignored_harmonics(command));
        said
    }

    /// That a search for periodic motions of a whole body knows no circumferential harmonics.
    fn ignored_harmonics(&self, command: &str) -> Option<Diagnostic> {
        let is_heard = command == "cycle" && !self.has_rotating_waves();
        self.cycle.as_ref()?.harmonics.as_ref().filter(|_| is_heard)?;
        let key = "cycle.harmonics";
        Some(diagnosis!(self, key,
            "{key} is not used: the limit cycles of this body are no rotating waves. They are \
             motions of the whole mesh, one for each mode that grows"; "not used"))
    }
}
