//! Where the ticks of a match lie on its line. Pure.

use bevy_egui::egui::Rect;

/// How long a match is, as far as one can tell: with the breaks that it has had so far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeScale {
    /// The last tick on the line.
    pub last: u64,
    /// The ticks at which halves begin and end.
    pub halves: [u64; 3],
    /// What the clock shows at the end, s.
    pub whole: f64,
    /// Seconds of a tick, if the clock goes on in breaks.
    steady: Option<f64>,
}

/// How far a match has been played.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlayedSoFar {
    /// Ticks.
    pub ticks: u64,
    /// Playing time, s.
    pub seconds: f64,
    /// The tick in which the first half ended, if it has.
    pub half_time: Option<u64>,
}

impl TimeScale {
    /// A match with halves of so many seconds, from a first tick.
    pub fn of_match(first: u64, played: PlayedSoFar, half_seconds: f64, dt: f32) -> TimeScale {
        let whole = 2.0 * half_seconds;
        let after = |seconds: f64| played.ticks + (seconds.max(0.0) / f64::from(dt)).round() as u64;
        let last = after(whole - played.seconds);
        let half_time = played.half_time.unwrap_or_else(|| after(half_seconds - played.seconds));
        TimeScale { last: last.max(first + 1), halves: [first, half_time, last], whole, steady: None }
    }

    /// A scenario that ends after a tick.
    pub fn of_scenario(played: PlayedSoFar, end: u64, dt: f32) -> TimeScale {
        let whole = (end as f64 * f64::from(dt)).round();
        let last = end.max(played.ticks).max(1);
        TimeScale { last, halves: [0, end, end], whole, steady: Some(f64::from(dt)) }
    }

    /// What the clock shows at a tick at which so many seconds have been played: in a scenario, which ends whatever is played, all
    /// that are over.
    pub fn clock(&self, tick: u64, played: f64) -> f64 {
        self.steady.map_or(played, |dt| tick as f64 * dt)
    }

    /// Where a tick lies on a line.
    pub fn x(&self, line: Rect, tick: u64) -> f32 {
        let share = (tick.saturating_sub(self.halves[0])) as f64 / (self.last - self.halves[0]).max(1) as f64;
        line.left() + share.clamp(0.0, 1.0) as f32 * line.width()
    }

    /// The tick that lies nearest to a place on a line.
    pub fn tick(&self, line: Rect, x: f32) -> u64 {
        let share = f64::from((x - line.left()) / line.width().max(1.0)).clamp(0.0, 1.0);
        self.halves[0] + (share * (self.last - self.halves[0]) as f64).round() as u64
    }
}

#[cfg(test)]
mod tests {
    use bevy_egui::egui::{pos2, vec2};

    use super::*;

    fn line() -> Rect {
        Rect::from_min_size(pos2(50.0, 0.0), vec2(200.0, 20.0))
    }

    #[test]
    fn half_time_is_in_the_middle_until_there_are_breaks() {
        let played = PlayedSoFar { ticks: 0, seconds: 0.0, half_time: None };
        let scale = TimeScale::of_match(0, played, 600.0, 1.0 / 60.0);
        assert_eq!((scale.last, scale.halves[1]), (72_000, 36_000));
        assert_eq!((scale.x(line(), 36_000), scale.clock(900, 12.0)), (150.0, 12.0));
        let played = PlayedSoFar { ticks: 42_000, seconds: 660.0, half_time: Some(36_600) };
        let scale = TimeScale::of_match(0, played, 600.0, 1.0 / 60.0);
        assert_eq!((scale.last, scale.halves[1]), (42_000 + 32_400, 36_600));
    }

    #[test]
    fn a_place_on_the_line_is_the_tick_that_lies_there() {
        let played = PlayedSoFar { ticks: 0, seconds: 0.0, half_time: None };
        let scale = TimeScale::of_scenario(played, 600, 1.0 / 60.0);
        for tick in [0, 3, 300, 599, 600] {
            assert_eq!(scale.tick(line(), scale.x(line(), tick)), tick);
        }
        assert_eq!((scale.tick(line(), -50.0), scale.tick(line(), 1e6)), (0, 600));
        assert_eq!(
            (scale.whole, scale.clock(600, 7.0).round()),
            (10.0, 10.0),
            "a break of three seconds counts"
        );
    }
}
