//! What is asked for in the panel becomes requests and files.

use std::path::Path;
use std::sync::Arc;

use super::files;
use super::history::CameraValues;
use super::view::CalibrationWish;
use crate::data::{AssetFolder, AssetKind};
use crate::game::requests::{Request, Requests, RobotChange};
use crate::game::{MatchPlan, Senses};
use crate::ids::{RobotId, Team};
use crate::vision::CameraCalibration;

/// What wishes are carried out on.
pub struct CameraWishes<'a> {
    /// Whose camera it is.
    pub robot: RobotId,
    /// Its calibration, with what waits for the next tick.
    pub calibration: &'a CameraCalibration,
    pub assets: &'a AssetFolder,
    /// The match, as its files have it.
    pub plan: Option<&'a mut MatchPlan>,
    pub requests: &'a mut Requests,
}

impl CameraWishes<'_> {
    /// Carries a wish out; `robots` are all that have a camera. Says what became of one about a file, and whether it went well.
    pub fn carry_out(&mut self, wish: CalibrationWish, robots: &[RobotId]) -> Option<(bool, String)> {
        let robot = self.robot;
        match wish {
            CalibrationWish::Camera(settings) => self.ask(robot, RobotChange::SetCamera(settings)),
            CalibrationWish::Colours(colours) => self.ask(robot, RobotChange::SetColours(colours)),
            CalibrationWish::Light(light) => self.requests.ask(Request::Light(light)),
            CalibrationWish::Save(name) => {
                let saved = files::save(self.assets, &name, self.calibration);
                return Some(match saved {
                    Ok(path) => (true, self.play_on_with(&path, robots)),
                    Err(error) => (false, error),
                });
            }
            CalibrationWish::Load(name) => {
                let told = match files::load(self.assets, &name) {
                    Ok(file) => {
                        self.set(robot, CameraValues::of(&file));
                        (true, format!("{robot} plays on with {name}"))
                    }
                    Err(error) => (false, error),
                };
                return Some(told);
            }
        }
        None
    }

    fn ask(&mut self, robot: RobotId, change: RobotChange) {
        self.requests.ask(Request::Robot(robot, change));
    }

    fn set(&mut self, robot: RobotId, CameraValues { settings, colours }: CameraValues) {
        self.ask(robot, RobotChange::SetCamera(settings));
        self.ask(robot, RobotChange::SetColours(colours));
    }

    /// All robots whose preset names a file that was written play on with it; who they are, in words.
    fn play_on_with(&mut self, path: &Path, robots: &[RobotId]) -> String {
        let calibration = Arc::new(self.calibration.clone());
        let assets = self.assets;
        let is_named = |senses: &Senses| {
            let named = senses.sensing.eyes.calibration();
            named.is_some_and(|name| assets.file(AssetKind::Camera, name) == path)
        };
        let mut named = Vec::new();
        if let Some(plan) = self.plan.as_deref_mut() {
            for team in &mut plan.teams {
                let all = std::iter::once(&mut team.senses).chain(team.senses_of.values_mut());
                all.filter(|senses| is_named(senses))
                    .for_each(|senses| senses.calibration = Some(calibration.clone()));
            }
            let is_of_file = |robot: &RobotId| is_named(plan.team(robot.team).senses(robot.number));
            named.extend(robots.iter().copied().filter(is_of_file));
        }
        for robot in &named {
            self.set(*robot, CameraValues::of(&calibration));
        }
        let teams: Vec<Team> =
            Team::BOTH.into_iter().filter(|team| named.iter().any(|robot| robot.team == *team)).collect();
        let file = path.display();
        match teams.as_slice() {
            [] => format!("Saved {file}, which no preset of this match names"),
            [team] => format!("Saved {file}; {team} plays on with it"),
            _ => format!("Saved {file}; both teams play on with it"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;
    use crate::game::Choice;

    const HOME: RobotId = RobotId::new(Team::Home, 1);
    const AWAY: RobotId = RobotId::new(Team::Away, 2);

    /// Carries a wish out for a robot of a match by pictures, with files in a folder.
    fn wish(assets: &AssetFolder, wish: CalibrationWish) -> (MatchPlan, Requests, Option<(bool, String)>) {
        let shipped = AssetFolder::new(concat!(env!("CARGO_MANIFEST_DIR"), "/assets"));
        let choice = Choice { file: Some("friendly_images".into()), ..Choice::default() };
        let mut plan = MatchPlan::read(&shipped, &choice).expect("a shipped match");
        let mut requests = Requests::default();
        let told = CameraWishes {
            robot: HOME,
            calibration: &samples::calibration(),
            assets,
            plan: Some(&mut plan),
            requests: &mut requests,
        }
        .carry_out(wish, &[HOME, AWAY]);
        (plan, requests, told)
    }

    #[test]
    fn what_is_saved_under_the_name_that_presets_have_is_at_once_what_all_their_robots_use() {
        let folder = tempfile::tempdir().expect("a folder");
        let assets = AssetFolder::new(folder.path());
        let (plan, requests, told) = wish(&assets, CalibrationWish::Save("cye_2001".into()));
        assert!(told.is_some_and(|(well, words)| well && words.contains("both teams play on")));
        let saved = files::load(&assets, "cye_2001").expect("it is there");
        for team in Team::BOTH {
            assert_eq!(plan.team(team).senses.calibration.as_deref(), Some(&saved));
        }
        let asked: Vec<&Request> = requests.iter().collect();
        for robot in [HOME, AWAY] {
            let settings = Request::Robot(robot, RobotChange::SetCamera(saved.settings));
            let colours = Request::Robot(robot, RobotChange::SetColours(saved.colours.clone()));
            assert!(asked.contains(&&settings) && asked.contains(&&colours), "{robot}: {asked:?}");
        }
    }

    #[test]
    fn another_name_changes_no_robot_until_it_is_loaded() {
        let folder = tempfile::tempdir().expect("a folder");
        let assets = AssetFolder::new(folder.path());
        let (_, requests, told) = wish(&assets, CalibrationWish::Save("mine".into()));
        assert!(told.is_some_and(|(well, words)| well && words.contains("no preset")));
        assert_eq!(requests.iter().count(), 0);
        let (_, requests, told) = wish(&assets, CalibrationWish::Load("mine".into()));
        assert_eq!((requests.iter().count(), told.map(|told| told.0)), (2, Some(true)));
        let (_, requests, told) = wish(&assets, CalibrationWish::Load("yours".into()));
        assert_eq!((requests.iter().count(), told.map(|told| told.0)), (0, Some(false)));
    }
}
