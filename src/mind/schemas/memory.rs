//! Operators with a state, as plain structs: what was seen lately, what was true lately, what has not been
//! true for long, and a threshold with two edges. The time in seconds is an argument, so are the settings: a
//! reloaded strategy keeps its memory. A clock that was set back never leaves one stuck.
//!
//! Source: Clay's PersistBlend, Persist and WatchDog nodes.

use bevy::prelude::*;

/// How many readings a [`Remembered`] holds at most.
pub const SLOTS: usize = 16;

/// How a [`Remembered`] treats its readings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keep {
    /// How long a reading is remembered, in seconds.
    pub seconds: f32,
    /// Readings at most this many metres from a remembered point are the same thing.
    pub merge: f32,
    /// The share of the old place in the new one, 0 (the reading replaces it) to 1 (the first place stays).
    pub blend: f32,
}

impl Default for Keep {
    /// Clay's settings for targets such as the ball.
    fn default() -> Keep {
        Keep { seconds: 2.0, merge: 0.3, blend: 0.75 }
    }
}

/// Readings of the last seconds (Clay's PersistBlend). The points must be in a frame that stands still, the
/// team frame's field and not the robot's vectors, or they would move along with it. At most [`SLOTS`]; the
/// oldest gives way.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Remembered {
    slots: [Slot; SLOTS],
    used: usize,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Slot {
    place: Vec2,
    seen: f32,
}

impl Remembered {
    /// Forgets what is too old, then takes in the readings of `now`: each blends into the nearest remembered
    /// point within reach or takes a slot of its own.
    pub fn update(&mut self, readings: impl IntoIterator<Item = Vec2>, now: f32, keep: &Keep) {
        self.forget(now, keep.seconds);
        for reading in readings {
            self.take_in(reading, now, keep);
        }
    }

    /// The remembered points, in the order in which they were first seen but for slots that were given away.
    pub fn points(&self) -> impl Iterator<Item = Vec2> + Clone + '_ {
        self.slots[..self.used].iter().map(|slot| slot.place)
    }

    fn forget(&mut self, now: f32, seconds: f32) {
        let mut kept = 0;
        for index in 0..self.used {
            if (0.0..=seconds).contains(&(now - self.slots[index].seen)) {
                self.slots[kept] = self.slots[index];
                kept += 1;
            }
        }
        self.slots[kept..self.used].fill(Slot::default());
        self.used = kept;
    }

    fn take_in(&mut self, reading: Vec2, now: f32, keep: &Keep) {
        let distance = |slot: &Slot| slot.place.distance(reading);
        let known = self.slots[..self.used]
            .iter_mut()
            .filter(|slot| distance(slot) <= keep.merge)
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        if let Some(slot) = known {
            *slot = Slot { place: reading.lerp(slot.place, keep.blend), seen: now };
        } else if self.used < SLOTS {
            self.slots[self.used] = Slot { place: reading, seen: now };
            self.used += 1;
        } else if let Some(oldest) = self.slots.iter_mut().min_by(|a, b| a.seen.total_cmp(&b.seen)) {
            *oldest = Slot { place: reading, seen: now };
        }
    }
}

/// True while its input is or was true within the last `seconds` (Clay's Persist of a condition).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HoldFor {
    last_true: Option<f32>,
}

impl HoldFor {
    /// Takes the input of `now` (seconds) and tells the held one.
    pub fn update(&mut self, input: bool, now: f32, seconds: f32) -> bool {
        if input {
            self.last_true = Some(now);
        }
        self.last_true.is_some_and(|last| (0.0..=seconds).contains(&(now - last)))
    }
}

/// Becomes true for `alarm` seconds when its input has not been true for `idle` seconds, and then starts again
/// (Clay's WatchDog). Feeding it does not cut an alarm short: the way out of trouble is gone to its end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Watchdog {
    fed: Option<f32>,
    alarmed: Option<f32>,
}

impl Watchdog {
    /// Takes the input of `now` (seconds) and tells whether there is an alarm. The wait begins with the first
    /// call.
    pub fn update(&mut self, input: bool, now: f32, idle: f32, alarm: f32) -> bool {
        if let Some(since) = self.alarmed {
            if (0.0..alarm).contains(&(now - since)) {
                return true;
            }
            *self = Watchdog::default();
        }
        let fed = self.fed.filter(|&fed| !input && fed <= now).unwrap_or(now);
        self.fed = Some(fed);
        if !input && now - fed >= idle {
            self.alarmed = Some(now);
        }
        self.alarmed.is_some()
    }
}

/// A threshold with two edges: turns on below `enter`, off above `leave`, and stays as it was between.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Hysteresis {
    on: bool,
}

impl Hysteresis {
    /// Takes a value in the unit of both edges. A `leave` below `enter` counts as `enter`.
    pub fn update(&mut self, value: f32, enter: f32, leave: f32) -> bool {
        self.on = if self.on { value <= leave.max(enter) } else { value < enter };
        self.on
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KEEP: Keep = Keep { seconds: 2.0, merge: 0.3, blend: 0.75 };

    fn points(memory: &Remembered) -> Vec<Vec2> {
        memory.points().collect()
    }

    #[test]
    fn a_reading_is_remembered_for_the_given_seconds_and_no_longer() {
        let mut memory = Remembered::default();
        memory.update([Vec2::X], 10.0, &KEEP);
        memory.update([], 12.0, &KEEP);
        assert_eq!(points(&memory), [Vec2::X]);
        memory.update([], 12.01, &KEEP);
        assert_eq!(memory, Remembered::default());
    }

    #[test]
    fn a_reading_near_a_remembered_point_blends_and_renews_it() {
        let mut memory = Remembered::default();
        memory.update([Vec2::X], 0.0, &KEEP);
        memory.update([Vec2::new(1.0, 0.2)], 1.5, &KEEP);
        let blended = points(&memory);
        assert!(blended.len() == 1 && (blended[0] - Vec2::new(1.0, 0.05)).length() < 1e-6, "{blended:?}");
        memory.update([], 3.4, &KEEP);
        assert_eq!(points(&memory), blended);
    }

    #[test]
    fn a_reading_out_of_reach_is_another_thing() {
        let mut memory = Remembered::default();
        memory.update([Vec2::X, Vec2::new(1.0, 0.31)], 0.0, &KEEP);
        assert_eq!(points(&memory), [Vec2::X, Vec2::new(1.0, 0.31)]);
    }

    #[test]
    fn a_reading_blends_into_the_nearest_of_two() {
        let mut memory = Remembered::default();
        memory.update([Vec2::ZERO, Vec2::new(0.4, 0.0)], 0.0, &KEEP);
        memory.update([Vec2::new(0.22, 0.0)], 0.1, &Keep { blend: 0.0, ..KEEP });
        assert_eq!(points(&memory), [Vec2::ZERO, Vec2::new(0.22, 0.0)]);
    }

    #[test]
    fn the_oldest_of_sixteen_gives_way_to_a_seventeenth() {
        let mut memory = Remembered::default();
        let place = |i: usize| Vec2::new(i as f32, 0.0);
        for i in 0..SLOTS {
            memory.update([place(i)], i as f32 * 0.01, &KEEP);
        }
        memory.update([place(0)], 0.5, &KEEP);
        memory.update([place(100)], 0.6, &KEEP);
        let now = points(&memory);
        assert_eq!(now.len(), SLOTS);
        assert!(now.contains(&place(100)) && now.contains(&place(0)) && !now.contains(&place(1)), "{now:?}");
    }

    #[test]
    fn forgetting_one_keeps_the_order_of_the_others() {
        let mut memory = Remembered::default();
        memory.update([Vec2::ZERO], 0.0, &KEEP);
        memory.update([Vec2::X, Vec2::Y], 1.0, &KEEP);
        memory.update([Vec2::NEG_X], 2.5, &KEEP);
        assert_eq!(points(&memory), [Vec2::X, Vec2::Y, Vec2::NEG_X]);
    }

    #[test]
    fn a_clock_set_back_forgets_readings_of_the_future() {
        let mut memory = Remembered::default();
        memory.update([Vec2::X], 600.0, &KEEP);
        memory.update([Vec2::Y], 0.0, &KEEP);
        assert_eq!(points(&memory), [Vec2::Y]);
    }

    #[test]
    fn hold_is_true_until_the_input_was_false_for_longer_than_asked() {
        let mut hold = HoldFor::default();
        assert!(!hold.update(false, 0.0, 1.0));
        assert!(hold.update(true, 1.0, 1.0));
        assert!(hold.update(false, 2.0, 1.0));
        assert!(!hold.update(false, 2.1, 1.0));
        assert!(!HoldFor { last_true: Some(600.0) }.update(false, 0.0, 1.0));
    }

    #[test]
    fn an_unfed_watchdog_is_true_for_the_alarm_and_then_waits_again() {
        let mut dog = Watchdog::default();
        let seen: Vec<bool> = (0..=11).map(|s| dog.update(false, s as f32, 3.0, 2.0)).collect();
        let alarms: Vec<usize> = (0..=11).filter(|&s| seen[s]).collect();
        assert_eq!(alarms, [3, 4, 8, 9]);
    }

    #[test]
    fn a_fed_watchdog_stays_quiet() {
        let mut dog = Watchdog::default();
        assert!((0..100).all(|s| !dog.update(s % 3 == 0, s as f32, 3.0, 2.0)));
        assert!(!dog.update(true, 500.0, 3.0, 2.0));
    }

    #[test]
    fn feeding_does_not_cut_an_alarm_short() {
        let mut dog = Watchdog::default();
        dog.update(true, 0.0, 3.0, 2.0);
        assert!(dog.update(false, 3.0, 3.0, 2.0));
        assert!(dog.update(true, 4.0, 3.0, 2.0));
        assert!(!dog.update(true, 5.0, 3.0, 2.0));
        assert!(!dog.update(false, 7.9, 3.0, 2.0));
        assert!(dog.update(false, 8.0, 3.0, 2.0));
    }

    #[test]
    fn a_watchdog_survives_a_clock_set_back() {
        let mut dog = Watchdog::default();
        dog.update(true, 600.0, 3.0, 2.0);
        assert!(!dog.update(false, 0.0, 3.0, 2.0));
        assert!(dog.update(false, 3.0, 3.0, 2.0));
    }

    #[test]
    fn hysteresis_turns_on_below_enter_and_off_above_leave() {
        let mut near = Hysteresis::default();
        let seen: Vec<bool> =
            [0.9, 0.7, 0.69, 0.9, 1.0, 1.01, 0.9].map(|d| near.update(d, 0.7, 1.0)).to_vec();
        assert_eq!(seen, [false, false, true, true, true, false, false]);
    }

    #[test]
    fn hysteresis_with_crossed_edges_is_one_threshold() {
        let mut near = Hysteresis::default();
        assert!((0..4).all(|_| near.update(0.6, 0.7, 0.5)));
        assert!(!near.update(0.71, 0.7, 0.5));
    }
}
