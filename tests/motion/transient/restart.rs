//! Saved and restored states.

use super::*;

struct StopAt {
    record: Recorder,
    index: u64,
    saved: Option<Vec<u8>>,
}

impl Observer for StopAt {
    fn observe(&mut self, sample: &Sample<'_>) -> ControlFlow<()> {
        let _ = self.record.observe(sample);
        if sample.index == self.index {
            self.saved = Some(postcard::to_stdvec(&(sample.state(), &self.record)).unwrap());
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

#[test]
fn restarted_run_equals_uninterrupted_run_bitwise() {
    let annulus = disc(45, 9);
    let rigid = model(&annulus, 610.0);
    // Friction that remembers nothing and springs that are where their nodes are.
    let mut compliant = rigid;
    compliant.contact.decay = Some(FrictionDecay { static_ratio: 1.4, decay_speed: 0.5 });
    compliant.stiffness = crate::disc::compliant(2e12, [1e5, 1e4]);
    for (model, choice) in [
        (rigid, OperatorChoice::Cyclic),
        (rigid, OperatorChoice::Sparse),
        (compliant, OperatorChoice::Cyclic),
    ] {
        let operator = model.operator(choice, SimdLevel::detect()).unwrap();
        let settings = kicked(4e-3, &[1, 2], 2.0);
        let (probes, snapshots) = (vec![1, 17], vec![1e-3, 3e-3]);
        let wanted = RecorderSettings { probes, snapshots, ..Default::default() };
        let start = || CentralDifference::start(model, operator.as_ref(), &settings).unwrap();
        let mut run = start();
        let mut whole = Recorder::new(&run, &wanted).unwrap();
        assert_eq!(run.run(&mut whole).unwrap(), RunEnd::Finished);
        let end = run.state();
        let mut first = start();
        let mut stop =
            StopAt { record: Recorder::new(&first, &wanted).unwrap(), index: 617, saved: None };
        assert_eq!(first.run(&mut stop).unwrap(), RunEnd::Stopped);
        let (state, mut record): (TransientState, Recorder) =
            postcard::from_bytes(&stop.saved.unwrap()).unwrap();
        let mut second =
            CentralDifference::resume(model, operator.as_ref(), &settings, &state).unwrap();
        assert_eq!(second.run(&mut record).unwrap(), RunEnd::Finished);
        assert_eq!(second.state(), end);
        assert_eq!(record, whole);
    }
}
