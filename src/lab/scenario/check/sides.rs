//! Checks of the sides: who takes part, where, and in which role.

use super::{Checked, Checker, ScenarioPlayer};
use crate::data::{Bound, Field, no_such};
use crate::geometry::Pose;
use crate::ids::{RobotId, Team};
use crate::lab::scenario::file::{PlayerFile, SideFile};

impl Checker<'_> {
    pub(super) fn side(&mut self, team: Team, side: &SideFile, at: &Field) -> Checked<Vec<ScenarioPlayer>> {
        let players = match &side.players {
            Some(players) if players.is_empty() => {
                return self.fault(&at.key("players"), "needs at least one robot");
            }
            Some(players) => {
                let at = |i| at.key("players").index(i);
                players.iter().enumerate().map(|(i, it)| (it.clone(), at(i), at(i).key("at"))).collect()
            }
            None => self.line_up(team, side, at)?,
        };
        let players = players.iter().map(|(player, at, place)| self.player(team, player, at, place));
        let mut players = players.collect::<Checked<Vec<_>>>()?;
        players.sort_by_key(|player| player.id);
        Ok(players)
    }

    /// All players of a strategy at the places of one of its line-ups, and where the file says so.
    fn line_up(&self, team: Team, side: &SideFile, at: &Field) -> Checked<Vec<(PlayerFile, Field, Field)>> {
        let known = &self.known.teams[team.index()];
        let (places, at) = match &side.line_up {
            None => (known.kick_off, at.clone()),
            Some(name) => {
                let at = at.key("line_up");
                match known.line_ups.get(name.as_str()) {
                    Some(places) => (*places, at),
                    None => return self.fault(&at, no_such("line-up", name, known.line_ups.keys())),
                }
            }
        };
        let players = (0..).zip(places).map(|(number, place)| PlayerFile::at(number, *place));
        Ok(players.map(|player| (player, at.clone(), at.clone())).collect())
    }

    /// A player that the file has at `at`, and its place at `place`.
    fn player(
        &mut self,
        team: Team,
        player: &PlayerFile,
        at: &Field,
        place: &Field,
    ) -> Checked<ScenarioPlayer> {
        let id = RobotId::new(team, player.number);
        let players = self.known.teams[team.index()].kick_off.len();
        if usize::from(player.number) >= players {
            let known = (0..players).map(|number| number.to_string());
            return self
                .fault(&at.key("number"), no_such("player with number", &player.number.to_string(), known));
        }
        if self.robots.contains(&id) {
            return self.fault(&at.key("number"), format!("{id} is given twice"));
        }
        self.on_pitch(player.at, place)?;
        self.source.within(&at.key("facing"), player.facing, Bound::HEADING)?;
        if let Some(role) = &player.role {
            self.role(team, role, &at.key("role"))?;
        }
        self.robots.push(id);
        let pose = Pose { position: player.at, heading: player.facing.to_radians() };
        self.stands(id, pose, place);
        Ok(ScenarioPlayer { id, pose, role: player.role.clone(), on: !player.off })
    }
}
