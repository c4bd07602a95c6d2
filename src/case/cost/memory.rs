//! Memory of each command, and which key asks for it.

use crate::case::{Case, CaseErrors, refusal};

impl Case {
    /// Memory that a command needs, bytes, and the key that asks for most of it.
    pub fn memory(&self, command: &str) -> (f64, &'static str) {
        let cost = self.cost();
        let mesh = self.larger_count();
        let own = match command {
            "cea" | "improve" | "mac" => cost.cea.map(|cea| (cea.run.memory_bytes, mesh)),
            "transient" => {
                cost.transient.map(|transient| (transient.run.memory_bytes, self.record_key()))
            }
            "cycle" => cost.cycle.map(|cycle| {
                let phases = self.cycle.as_ref().and_then(|cycle| cycle.phases);
                let key = match phases {
                    Some(_) if self.has_rotating_waves() => "cycle.phases",
                    _ => mesh,
                };
                (cycle.run.memory_bytes, key)
            }),
            "frf" => cost.frf.map(|frf| (frf.run.memory_bytes, mesh)),
            "sweep" => self
                .sweep_cost()
                .map(|sweep| (sweep.run.memory_bytes - cost.mesh_memory_bytes, mesh)),
            "convergence" => {
                self.convergence_cost().map(|study| (study.run.memory_bytes, "convergence.factors"))
            }
            _ => None,
        };
        let (bytes, key) = own.unwrap_or((0.0, mesh));
        let blamed = if bytes > cost.mesh_memory_bytes { key } else { mesh };
        (cost.mesh_memory_bytes + bytes.max(0.0), blamed)
    }

    /// The error of a command that needs more memory than there is.
    pub fn memory_error(&self, command: &str, needed: f64, available: f64) -> CaseErrors {
        let key = self.memory(command).1;
        let gibibytes = |bytes: f64| bytes / f64::from(1 << 30);
        let value = self.raw.find(key).map(|item| item.value.shortened());
        let given = value.map_or_else(String::new, |value| format!(" = {value}"));
        let remedy = match key {
            "output.sample_interval" => "raise it, or lower transient.duration",
            "output.contact_interval" => "raise it, or lower transient.duration",
            "transient.duration" => "lower it, or raise output.sample_interval",
            "output.snapshots" | "cycle.phases" => "lower it",
            "convergence.factors" => "lower the factors, or start from a coarser mesh",
            "mesh.file" => "mesh the body more coarsely",
            _ => "lower mesh.circumferential_elements or mesh.radial_elements",
        };
        refusal!(self, key,
            "{command} needs about {:.1} GiB of memory, {:.1} GiB are available: most of it for \
             {key}{given}", gibibytes(needed), gibibytes(available); "too much for this machine";
            "{remedy}")
    }

    /// What the size of the mesh comes from: the element count that is further from a usual one, or the file.
    fn larger_count(&self) -> &'static str {
        match self.body.grid() {
            None => "mesh.file",
            Some(grid) if grid.radial_elements > grid.circumferential_elements => {
                "mesh.radial_elements"
            }
            Some(_) => "mesh.circumferential_elements",
        }
    }

    /// What makes the record of a transient large: its length, its samples, or its snapshots.
    fn record_key(&self) -> &'static str {
        // Usual ones: 0.05 s and 2 us.
        let length = self.transient.as_ref().map_or(0.0, |run| run.duration) / 0.05;
        let density = 2e-6 / self.output.sample_interval;
        let samples = self.sample_bytes() + self.frame_bytes();
        let snapshots = self.snapshot_bytes();
        let body = 320.0 * self.body.node_count() as f64;
        if snapshots > samples.max(body) {
            "output.snapshots"
        } else if self.output.contact_interval.is_some() && self.frame_bytes() > self.sample_bytes()
        {
            "output.contact_interval"
        } else if length.max(density) < 10.0 {
            self.larger_count()
        } else if density > length {
            "output.sample_interval"
        } else {
            "transient.duration"
        }
    }
}
