//! Makes a match in which something breaks as small as it gets: with fewer faults and robots, over a better radio, without opponents.

use crate::lab::scenario::ScenarioFile;

/// The smallest match that still fails, by a greedy search, and how many matches that took. `fails` plays one.
pub(super) fn shrink(
    mut file: ScenarioFile,
    mut fails: impl FnMut(&ScenarioFile) -> bool,
) -> (ScenarioFile, u32) {
    let mut played = 0;
    let mut attempt = |file: &mut ScenarioFile, smaller: ScenarioFile| {
        if smaller == *file {
            return false;
        }
        played += 1;
        let is_kept = fails(&smaller);
        if is_kept {
            *file = smaller;
        }
        is_kept
    };
    for radio in ["perfect", "good"] {
        let smaller = ScenarioFile { radio: Some(radio.into()), ..file.clone() };
        if attempt(&mut file, smaller) {
            break;
        }
    }
    let without_opponents = ScenarioFile { away: None, ..file.clone() };
    attempt(&mut file, without_opponents);
    fewer(&mut file, &mut attempt, |file| Some(&mut file.script));
    fewer(&mut file, &mut attempt, |file| Some(&mut file.faults));
    fewer(&mut file, &mut attempt, |file| file.home.as_mut()?.players.as_mut());
    fewer(&mut file, &mut attempt, |file| file.away.as_mut()?.players.as_mut());
    (file, played)
}

/// Leaves out of a list whatever can go: larger parts first, half of it, a quarter, down to single entries; again, until no single one
/// can go.
fn fewer<T>(
    file: &mut ScenarioFile,
    attempt: &mut impl FnMut(&mut ScenarioFile, ScenarioFile) -> bool,
    list: impl Fn(&mut ScenarioFile) -> Option<&mut Vec<T>>,
) {
    let entries = |file: &mut ScenarioFile| list(file).map_or(0, |list| list.len());
    let mut size = entries(file).next_power_of_two().div_ceil(2);
    while size > 0 {
        let (mut at, mut is_smaller) = (0, false);
        while at < entries(file) {
            let mut smaller = file.clone();
            if let Some(list) = list(&mut smaller) {
                list.drain(at..(at + size).min(list.len()));
            }
            if attempt(file, smaller) {
                is_smaller = true;
            } else {
                at += size;
            }
        }
        if size > 1 || !is_smaller {
            size /= 2;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ids::{RobotId, Team};
    use crate::lab::scenario::{Event, TimedEvent};

    fn crash(number: u8) -> TimedEvent {
        TimedEvent { at: f32::from(number), what: Event::Crash(RobotId::new(Team::Home, number)) }
    }

    #[test]
    fn only_the_events_that_it_takes_are_left() {
        let script: Vec<TimedEvent> = (0..23).map(crash).collect();
        let file = ScenarioFile { script, radio: Some("awful".into()), ..ScenarioFile::default() };
        let needs = |file: &ScenarioFile| [4, 17].iter().all(|number| file.script.contains(&crash(*number)));
        let (smallest, played) = shrink(file, needs);
        assert_eq!(smallest.script, [crash(4), crash(17)]);
        assert_eq!(smallest.radio.as_deref(), Some("perfect"));
        assert!(played < 60, "{played}");
    }

    #[test]
    fn what_takes_its_radio_keeps_it() {
        let file = ScenarioFile { radio: Some("awful".into()), ..ScenarioFile::default() };
        let (smallest, _) = shrink(file.clone(), |file| file.radio.as_deref() == Some("awful"));
        assert_eq!(smallest, file);
    }
}
