//! Samples of a run stay readable while it is under way, when its program is killed, and when it goes on.

use rotordyn::io::hdf5::{
    Channel, ChannelStream, Recording, RunFormat, Store, copy_run, preallocate_run, read_channel,
    read_recording, recorded_samples, run_state,
};
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

/// A file with a run of up to `samples` samples, under way.
pub fn begin(path: &Path, root: &str, format: &RunFormat, samples: usize) -> ChannelStream {
    let store = Store::replace(path).unwrap();
    preallocate_run(&store, root, format, samples).unwrap();
    store.commit().unwrap();
    ChannelStream::start(path, root).unwrap()
}

/// Ends a run: copies it into an open file.
pub fn end(stream: ChannelStream, path: &Path, root: &str, state: &str, store: &Store) {
    stream.finish().unwrap();
    copy_run(&Store::open(path).unwrap(), store, root, state).unwrap();
}

fn start(path: &Path, root: &str, samples: usize) -> ChannelStream {
    let channels = [channel("B_y"), channel("B_x")];
    begin(path, root, &RunFormat { channels: &channels, sample_rate: SAMPLE_RATE, start: 0.0 }, samples)
}

fn assert_contains(run: &Recording, samples: usize, state: &str) {
    assert_eq!(run.state, state);
    assert_eq!((run.sample_rate, run.start), (SAMPLE_RATE, 0.0));
    assert_eq!(
        run.channels.iter().map(|(c, _)| c.clone()).collect::<Vec<_>>(),
        [channel("B_x"), channel("B_y")]
    );
    // Recorded in the order B_y, B_x.
    let columns = [&run.time, &run.angle, &run.speed, &run.channels[1].1, &run.channels[0].1];
    for (k, column) in columns.into_iter().enumerate() {
        assert_eq!(column.len(), samples);
        assert!(column.iter().enumerate().all(|(row, value)| *value == sample(row)[k]), "column {k}");
    }
}

#[test]
fn complete_run_round_trip_is_exact() {
    let folder = tempfile::tempdir().unwrap();
    let [path, ended] = ["running.h5", "results.h5"].map(|name| folder.path().join(name));
    for (samples, state) in
        [(10_000, "complete"), (0, "stopped: Ctrl-C"), (4096, "complete"), (1, "complete")]
    {
        let mut stream = start(&path, "/spherical", 12_000);
        push(&mut stream, 0..samples);
        let store = Store::replace(&ended).unwrap();
        end(stream, &path, "/spherical", state, &store);
        store.commit().unwrap();
        let store = Store::open(&ended).unwrap();
        assert_contains(&read_recording(&store, "/spherical").unwrap(), samples, state);
        drop(store);
        // It has ended, whether its samples are compressed or not.
        let refused = ChannelStream::start(&ended, "/spherical").unwrap_err().to_string();
        assert!(refused.contains("no run under way"), "{refused}");
    }
}

/// A copy of the file during the run equals the file of a killed process; only bytes of samples have changed.
#[test]
fn killed_run_keeps_complete_blocks() {
    let folder = tempfile::tempdir().unwrap();
    let (path, copy) = (folder.path().join("running.h5"), folder.path().join("killed.h5"));
    let mut stream = start(&path, "", 20_000);
    let fresh = std::fs::read(&path).unwrap();
    for (from, to, kept) in [(0, 0, 0), (0, 1023, 0), (1023, 1024, 1024), (1024, 20_000, 19_456)] {
        push(&mut stream, from..to);
        std::fs::copy(&path, &copy).unwrap();
        let store = Store::open(&copy).unwrap();
        assert_contains(&read_recording(&store, "").unwrap(), kept, "running");
        let now = std::fs::read(&path).unwrap();
        assert_eq!(now.len(), fresh.len());
        let changed = now.iter().zip(&fresh).filter(|(a, b)| a != b).count();
        // Five columns of at most eight bytes each: nothing of HDF5 itself is among them.
        assert!(changed <= 40 * kept, "{changed} bytes for {kept} samples");
    }
    assert!(stream.push(4.0, 0.0, 0.0, &[0.0; 2]).unwrap_err().to_string().contains("announced"));
}

/// Samples are read back while the run goes on, and by another reader of the same file.
#[test]
fn samples_of_a_run_under_way_can_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("running.h5");
    let mut stream = start(&path, "", 5000);
    push(&mut stream, 0..1500);
    assert_eq!(stream.samples(), 1500);
    let expected: Vec<f64> = (1000..1500).map(|k| sample(k)[4]).collect();
    assert_eq!(stream.read_channel("B_x", 1000..1500).unwrap(), expected);
    assert!(stream.read_channel("B_x", 1000..1501).is_err());
    assert!(stream.read_channel("B_z", 0..1).unwrap_err().to_string().contains("B_z"));
    let store = Store::open(&path).unwrap();
    assert_eq!(recorded_samples(&store, "").unwrap(), 1500);
    assert_eq!(read_channel(&store, "", "B_x", 1000..1500).unwrap(), expected);
    assert!(read_channel(&store, "", "B_x", 5000..5001).is_err());
    assert_eq!(run_state(&store, "").unwrap().as_deref(), Some("running"));
}

/// A run that goes on at an earlier sample ends as if it had never been stopped.
#[test]
fn a_resumed_run_equals_an_unbroken_one() {
    let folder = tempfile::tempdir().unwrap();
    let paths = ["unbroken.h5", "resumed.h5"].map(|name| folder.path().join(name));
    let mut unbroken = start(&paths[0], "", 9000);
    push(&mut unbroken, 0..9000);
    unbroken.finish().unwrap();
    let mut stopped = start(&paths[1], "", 9000);
    push(&mut stopped, 0..5000);
    drop(stopped);
    for at in [4000, 4100, 0, 777] {
        let mut stream = ChannelStream::resume(&paths[1], "", at).unwrap();
        let store = Store::open(&paths[1]).unwrap();
        assert_contains(&read_recording(&store, "").unwrap(), at, "running");
        drop(store);
        push(&mut stream, at..at + 4000);
    }
    assert!(ChannelStream::resume(&paths[1], "", 4778).is_err(), "fewer samples are recorded");
    let mut stream = ChannelStream::resume(&paths[1], "", 4777).unwrap();
    push(&mut stream, 4777..9000);
    stream.finish().unwrap();
    assert!(std::fs::read(&paths[0]).unwrap() == std::fs::read(&paths[1]).unwrap());
}

#[test]
fn run_stopped_by_error_keeps_all_samples() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.h5");
    let mut stream = start(&path, "", 6000);
    push(&mut stream, 0..5000);
    assert!(stream.push(1.0, 1.0, 1.0, &[1.0]).is_err(), "one value for two channels");
    drop(stream);
    let store = Store::open(&path).unwrap();
    assert_contains(&read_recording(&store, "").unwrap(), 5000, "running");
}

#[test]
fn a_removed_file_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.h5");
    let mut stream = start(&path, "", 6000);
    push(&mut stream, 0..10);
    std::fs::remove_file(&path).unwrap();
    let error = stream.finish().unwrap_err();
    assert!(error.to_string().contains("removed during the run"), "{error}");
}

#[test]
fn channel_name_with_slash_is_rejected() {
    let folder = tempfile::tempdir().unwrap();
    let store = Store::replace(folder.path().join("results.h5")).unwrap();
    let format = RunFormat { channels: &[channel("B/x")], sample_rate: SAMPLE_RATE, start: 0.0 };
    let error = preallocate_run(&store, "", &format, 10).unwrap_err();
    assert!(error.to_string().contains("\"B/x\" cannot be the name of a channel"), "{error}");
    drop(store);
    assert_eq!(
        std::fs::read_dir(folder.path()).unwrap().count(),
        0,
        "nothing is left of a file not committed"
    );
}
