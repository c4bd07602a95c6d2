//! WAV files: sound in, and a signal made audible.

use super::super::SignalError;
use super::super::error::not_positive;
use super::error::ReadError;
use super::time_signal::{Channel, SignalFile};
use hound::{SampleFormat, WavReader, WavSpec, WavWriter};
use std::io::Cursor;

/// Highest sampling rate that is played as it is, Hz.
const FASTEST: f64 = 96_000.0;
/// Largest sample of a written file: full scale less 1 dB.
const PEAK: f64 = 0.89;

/// Reads all channels of a WAV file of integers or floating-point numbers; full scale reads 1.
pub(super) fn read_wav(bytes: &[u8]) -> Result<SignalFile, ReadError> {
    let damaged = |reason: String| ReadError::damaged("WAV", reason);
    let mut wav = WavReader::new(Cursor::new(bytes))
        .map_err(|error| damaged(format!("{error}; write PCM or 32-bit floating-point samples")))?;
    let spec = wav.spec();
    if spec.channels == 0 || spec.sample_rate == 0 || spec.bits_per_sample == 0 {
        return Err(damaged("no channels, or a sampling rate of 0".into()));
    }
    // What comes before a damaged sample is whole.
    let values: Vec<f64> = match spec.sample_format {
        SampleFormat::Float => wav.samples::<f32>().map_while(|v| Some(v.ok()?.into())).collect(),
        SampleFormat::Int => {
            let scale = 1.0 / 2f64.powi(i32::from(spec.bits_per_sample) - 1);
            let samples = wav.samples::<i32>();
            samples.map_while(|v| v.ok().map(|v| scale * f64::from(v))).collect()
        }
    };
    let count = usize::from(spec.channels);
    let rows = values.len() / count;
    let mut notes = Vec::new();
    if rows * count < wav.len() as usize {
        notes.push(format!("the file ends early: {rows} samples of each channel are read"));
    }
    let channels = (0..count.min(values.len())).map(|k| Channel {
        name: format!("channel {}", k + 1),
        samples: (0..rows).map(|i| values[i * count + k]).collect(),
    });
    let (sampling_rate, channels) = (f64::from(spec.sample_rate), channels.collect());
    Ok(SignalFile { sampling_rate, start: 0.0, channels, notes })
}

/// How many times slower a record of this sampling rate is played, so that a player takes it: 1, 2, 5, 10, 20, ...
pub fn slowdown(sampling_rate: f64) -> u32 {
    let steps = [1, 2, 5].map(f64::from);
    let factors = (0..8).flat_map(|k| steps.map(|step| step * 10f64.powi(k)));
    let mut factors = factors.filter(|factor| sampling_rate / factor <= FASTEST);
    factors.next().unwrap_or(1.0) as u32
}

/// The channels as a WAV file of 16 bits, each less its mean, all scaled by one factor to full scale less
/// 1 dB, `slower` times slower than they were recorded: 9.4 kHz sounds as 0.94 kHz at 10.
///
/// # Errors
/// [`SignalError::Asked`] for a rate of less than 1 Hz after slowing down.
pub fn write_wav(file: &SignalFile, slower: u32) -> Result<Vec<u8>, SignalError> {
    let rate = (file.sampling_rate / f64::from(slower.max(1))).round();
    let what = "sampling rate of the WAV file";
    let refused = |value| not_positive(what, value, " between 1 Hz and 4 GHz");
    if !(1.0..f64::from(u32::MAX)).contains(&rate) || file.channels.len() > usize::from(u16::MAX) {
        return Err(refused(rate));
    }
    let centred: Vec<Vec<f64>> =
        file.channels.iter().map(|c| crate::spectrum::centred(&c.samples)).collect();
    let largest = centred.iter().flatten().fold(0.0f64, |m, v| m.max(v.abs()));
    let gain = if largest > 0.0 { PEAK * f64::from(i16::MAX) / largest } else { 0.0 };
    let spec = WavSpec {
        channels: centred.len() as u16,
        sample_rate: rate as u32,
        bits_per_sample: 16,
        sample_format: SampleFormat::Int,
    };
    let mut out = Cursor::new(Vec::new());
    let written = WavWriter::new(&mut out, spec).and_then(|mut writer| {
        for i in 0..centred.first().map_or(0, Vec::len) {
            for samples in &centred {
                writer.write_sample((gain * samples[i]).round() as i16)?;
            }
        }
        writer.finalize()
    });
    // Memory takes what it is given; only more than 4 GB do not fit into the format.
    written.map_err(|_| refused(rate))?;
    Ok(out.into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_written_file_reads_back_slower_by_the_stated_factor_to_16_bits() {
        let tone = |k: usize| (0.2 * k as f64).sin();
        let file = SignalFile {
            sampling_rate: 5e5,
            start: 0.0,
            channels: [1.0, 0.25]
                .map(|a| Channel {
                    name: String::new(),
                    samples: (0..1000).map(|k| a * tone(k)).collect(),
                })
                .to_vec(),
            notes: Vec::new(),
        };
        assert_eq!((slowdown(5e5), slowdown(51_200.0), slowdown(192_000.0)), (10, 1, 2));
        let read = read_wav(&write_wav(&file, 10).unwrap()).unwrap();
        assert_eq!((read.sampling_rate, read.channels.len()), (5e4, 2));
        let mean = (0..1000).map(tone).sum::<f64>() / 1000.0;
        let top = (0..1000).map(|k| (tone(k) - mean).abs()).fold(0.0, f64::max);
        for k in 0..1000 {
            let want = 0.25 * PEAK * (tone(k) - mean) / top;
            // Half a unit of 16 bits, and the asymmetry of full scale.
            assert!((read.channels[1].samples[k] - want).abs() < 5e-5);
        }
    }
}
