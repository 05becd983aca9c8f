//! Crowding: for how long two or more robots of a team were near the ball, at several distances.

use serde::Serialize;

use super::play_tick::PlayTick;

/// The distances from the ball within which team mates are counted, m. None of them is taken from a strategy.
pub const RADII: [f32; 4] = [0.5, 0.75, 1.0, 1.5];
/// The place in [`RADII`] of an agglomeration of small robots (TeamChaos, section 5).
pub const AGGLOMERATION: usize = 0;
/// The place in [`RADII`] of a crowd.
pub const CROWD: usize = 2;

/// For how long two or more robots of a team were near the ball.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Crowding([[f64; 2]; RADII.len()]);

impl Crowding {
    pub(super) fn update(&mut self, tick: &PlayTick) {
        let mut near = [[0; 2]; RADII.len()];
        for player in &tick.players {
            for (radius, near) in RADII.iter().zip(&mut near) {
                near[player.id.team.index()] += u32::from(player.distance < *radius);
            }
        }
        for (near, seconds) in near.iter().zip(&mut self.0) {
            for team in [0, 1] {
                if near[team] >= 2 {
                    seconds[team] += tick.dt;
                }
            }
        }
    }

    /// Seconds with two or more robots of a team within a radius, which is named by its place in [`RADII`]; home first.
    pub fn seconds(&self, radius: usize) -> [f64; 2] {
        self.0[radius]
    }

    /// As [`Crowding::seconds`], for each radius in metres.
    pub fn by_radius(&self) -> [(f32, [f64; 2]); RADII.len()] {
        std::array::from_fn(|i| (RADII[i], self.0[i]))
    }
}

#[cfg(test)]
mod tests {
    use super::super::play_tick::stage::*;
    use super::*;

    fn seconds(players: &[super::super::play_tick::PlayerTick]) -> [[f64; 2]; 4] {
        let mut crowding = Crowding::default();
        crowding.update(&tick(players));
        crowding.0
    }

    #[test]
    fn two_of_one_team_crowd_the_ball_at_every_radius_that_holds_both() {
        let home = [player(HOME_1, 0.4, 0.0), player(HOME_2, 0.0, -0.9)];
        assert_eq!(seconds(&home), [[0.0, 0.0], [0.0, 0.0], [0.1, 0.0], [0.1, 0.0]]);
    }

    #[test]
    fn one_of_each_team_crowds_nothing_and_a_robot_on_the_line_is_outside() {
        assert_eq!(seconds(&[player(HOME_1, 0.1, 0.0), player(AWAY_1, -0.1, 0.0)]), [[0.0; 2]; 4]);
        assert_eq!(seconds(&[player(HOME_1, 0.1, 0.0), player(HOME_2, 1.5, 0.0)]), [[0.0; 2]; 4]);
    }
}
