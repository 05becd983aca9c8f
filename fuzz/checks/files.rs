//! What must hold of any file that people hand over.
#![allow(dead_code, reason = "each fuzz target calls one of these")]

use std::io::Write;
use std::path::{Path, PathBuf};

use flate2::Compression;
use flate2::write::DeflateEncoder;
use touchline::data::{AssetTexts, Source};
use touchline::lab::kinds;
use touchline::lab::replay::Replay;
use touchline::lab::scenario::ScenarioRef;
use xxhash_rust::xxh3::xxh3_64;

use super::shipped::shipped;

/// A text among the assets is a file of some kind, or is told not to be in one line that names a file.
pub fn asset(input: &[u8]) {
    let Ok(text) = std::str::from_utf8(input) else { return };
    let path = PathBuf::from("fuzzed.ron");
    let source = Source::new(&path, text);
    let error = match kinds::kind_of(&source) {
        Ok(kind) => {
            let assets = shipped().with_texts(AssetTexts::from([(path.clone(), text.to_owned())]));
            kinds::read(&assets, kind, &ScenarioRef::from(path.clone())).err()
        }
        Err(error) => Some(error),
    };
    let Some(error) = error else { return };
    let lines = text.split('\n').count();
    assert_eq!(error.to_string().lines().count(), 1, "{error}");
    assert!(error.path != path || error.line.is_none_or(|line| line <= lines), "{error}");
}

/// A file of frames is a recorded match, or is told not to be. The input is the frames as they are before they are compressed, each
/// with two bytes for its length before it.
pub fn replay(input: &[u8]) {
    let mut bytes = format!("touchline replay {}\n", env!("CARGO_PKG_VERSION")).into_bytes();
    let mut rest = input;
    while let [low, high, tail @ ..] = rest {
        let length = usize::from(u16::from_le_bytes([*low, *high]));
        let (plain, behind) = tail.split_at(length.min(tail.len()));
        rest = behind;
        bytes.extend(frame(plain));
    }
    for bytes in [&bytes[..], input] {
        let read = Replay::from_bytes(Path::new("fuzzed.replay"), bytes);
        match read.and_then(|replay| replay.plans().map(|plans| (replay, plans))) {
            Ok((replay, (plan, _))) => {
                assert!(plan.script.len() <= input.len() && replay.bookmarks().len() <= input.len())
            }
            Err(error) => assert_eq!(error.to_string().lines().count(), 1, "{error}"),
        }
    }
}

/// Compressed, with a length and a checksum.
fn frame(plain: &[u8]) -> Vec<u8> {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::fast());
    let written = encoder.write_all(plain).and_then(|()| encoder.finish());
    let data = written.expect("memory takes everything");
    let head = [data.len() as u32, xxh3_64(&data) as u32];
    head.into_iter().flat_map(u32::to_le_bytes).chain(data).collect()
}
