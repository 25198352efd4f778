//! Streamed channels stay readable after complete, killed and failed runs.

use rotordyn::io::hdf5::{Channel, ChannelStream, Recording, Store, read_recording};
use std::path::Path;

const SAMPLE_RATE: f64 = 5000.0;

fn channel(name: &str) -> Channel {
    Channel {
        name: name.into(),
        unit: "m/s2".into(),
        quantity: "acceleration".into(),
        station: "bearing B".into(),
        direction: "y".into(),
    }
}

/// Time, angle, speed and two channels of sample k.
fn sample(k: usize) -> [f64; 5] {
    let t = k as f64 / SAMPLE_RATE;
    [t, 3.0 * t * t, 6.0 * t, (40.0 * t).sin(), (50.0 * t).cos() * t]
}

fn push(stream: &mut ChannelStream, samples: std::ops::Range<usize>) {
    for k in samples {
        let [t, angle, speed, x, y] = sample(k);
        stream.push(t, angle, speed, &[x, y]).unwrap();
    }
}

fn start(path: &Path, at: &str) -> ChannelStream {
    let store = Store::append(path).unwrap();
    ChannelStream::create(&store, at, &[channel("B_x"), channel("B_y")], SAMPLE_RATE, 0.0).unwrap()
}

fn assert_contains(run: &Recording, samples: usize, state: &str) {
    assert_eq!(run.state, state);
    assert_eq!((run.sample_rate, run.start), (SAMPLE_RATE, 0.0));
    assert_eq!(
        run.channels.iter().map(|(c, _)| c.clone()).collect::<Vec<_>>(),
        [channel("B_x"), channel("B_y")]
    );
    let columns = [&run.time, &run.angle, &run.speed, &run.channels[0].1, &run.channels[1].1];
    for (k, column) in columns.into_iter().enumerate() {
        assert_eq!(column.len(), samples);
        assert!(column.iter().enumerate().all(|(row, value)| *value == sample(row)[k]), "column {k}");
    }
}

#[test]
fn complete_run_round_trip_is_exact() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.h5");
    let mut stream = start(&path, "/spherical");
    push(&mut stream, 0..10_000);
    stream.finish("complete").unwrap();
    start(&path, "").finish("stopped: Ctrl-C").unwrap();
    let store = Store::open(&path).unwrap();
    assert_contains(&read_recording(&store, "/spherical").unwrap(), 10_000, "complete");
    assert_contains(&read_recording(&store, "").unwrap(), 0, "stopped: Ctrl-C");
}

/// A copy of the file during the run equals the file of a killed process.
#[test]
fn killed_run_keeps_complete_blocks() {
    let folder = tempfile::tempdir().unwrap();
    let (path, copy) = (folder.path().join("results.h5"), folder.path().join("killed.h5"));
    let mut stream = start(&path, "");
    for (from, to, kept) in [(0, 0, 0), (0, 4095, 0), (4095, 4096, 4096), (4096, 20_000, 16_384)] {
        push(&mut stream, from..to);
        std::fs::copy(&path, &copy).unwrap();
        let store = Store::open(&copy).unwrap();
        assert_contains(&read_recording(&store, "").unwrap(), kept, "running");
    }
}

#[test]
fn run_stopped_by_error_keeps_all_samples() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.h5");
    let mut stream = start(&path, "");
    push(&mut stream, 0..5000);
    assert!(stream.push(1.0, 1.0, 1.0, &[1.0]).is_err(), "one value for two channels");
    drop(stream);
    let store = Store::open(&path).unwrap();
    assert_contains(&read_recording(&store, "").unwrap(), 5000, "stopped: not finished");
}

#[test]
fn channel_name_with_slash_is_rejected() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::create(folder.path().join("results.h5")).unwrap();
    let error = ChannelStream::create(&store, "", &[channel("B/x")], SAMPLE_RATE, 0.0).unwrap_err();
    assert!(error.to_string().contains("\"B/x\" cannot be the name of a channel"), "{error}");
}
