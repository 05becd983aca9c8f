//! `touchline chaos`: ChaosManager for one robot of a match that is elsewhere.

use std::io::Write;
use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::{ArgGroup, Args};

use super::ending::{CommandError, Ending, print_json, tell};
use super::interrupt::Interrupt;
use super::options::seconds;
use super::picture_file::PictureFormat;
use super::windows;
use crate::app::whole_file::{check_writable, write_whole};
use crate::data::{AssetFolder, DataError, Source};
use crate::game::net::NetworkError;
use crate::game::net::chaos::{ChaosLink, ChaosNews, Instruction, Refusal, StrategyText, Subscription};
use crate::game::{Choice, MatchPlan};
use crate::ids::RobotId;
use crate::vision::CameraCalibration;

#[derive(Args, Debug)]
#[command(group = ArgGroup::new("task").args(["image", "data", "strategy", "colours"]))]
pub(super) struct ChaosCommand {
    /// The match: what it was given as `--chaos`.
    #[arg(long, value_name = "ADDRESS")]
    connect: SocketAddr,
    /// The robot, such as `home:1`.
    #[arg(long, value_name = "ROBOT")]
    robot: RobotId,
    /// Fetch a picture of the robot's camera and write it to a file that ends in .png or .ppm.
    #[arg(long, value_name = "FILE")]
    image: Option<PathBuf>,
    /// Print what the robot believes, is in and wants, as JSON.
    #[arg(long)]
    data: bool,
    /// Let the robot's team play the strategy of a file from now on.
    #[arg(long, value_name = "FILE")]
    strategy: Option<PathBuf>,
    /// Set the robot's camera as a camera's file has its settings and colours.
    #[arg(long, value_name = "FILE")]
    colours: Option<PathBuf>,
    /// The match that is played there, as a name or a path: what the window recognises in pictures, and how the robot kicks.
    #[arg(long = "match", value_name = "MATCH")]
    game: Option<String>,
    /// How many seconds to wait for the match.
    #[arg(long, value_name = "SECONDS", default_value = "5", value_parser = seconds)]
    timeout: Duration,
}

/// How a talk has ended.
enum Talked<T> {
    Told(T),
    Refused(Refusal),
    Silence,
    Interrupted,
}

/// How often an interrupt is looked for.
const LOOK: Duration = Duration::from_millis(100);

impl ChaosCommand {
    /// Whether nothing was asked for that needs no window.
    pub(super) fn opens_window(&self) -> bool {
        self.image.is_none() && !self.data && self.strategy.is_none() && self.colours.is_none()
    }

    pub(super) fn run(&self, assets: &AssetFolder, out: &mut impl Write) -> Result<Ending, CommandError> {
        if self.opens_window() {
            return self.open_window(assets);
        }
        let mut link = ChaosLink::open(self.connect, self.robot)?;
        if let Some(path) = &self.image {
            return self.fetch_image(&mut link, path, out);
        }
        if let Some(path) = &self.strategy {
            let Source { text, .. } = Source::read(path)?;
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let strategy = Instruction::PlayStrategy(StrategyText { name, text });
            return self.give(&mut link, vec![strategy], out);
        }
        if let Some(path) = &self.colours {
            let CameraCalibration { settings, colours, .. } = Source::read(path)?.parse_sound()?;
            let orders = vec![Instruction::SetCamera(settings), Instruction::SetColours(colours)];
            return self.give(&mut link, orders, out);
        }
        self.print_data(&mut link, out)
    }

    fn open_window(&self, assets: &AssetFolder) -> Result<Ending, CommandError> {
        if let Some(missing) = windows::missing() {
            let instead = "--image, --data, --strategy and --colours need none";
            return Err(DataError::new("chaos", format!("{missing}; {instead}")).into());
        }
        let game = self
            .game
            .as_ref()
            .map(|game| MatchPlan::read(assets, &Choice { file: Some(game.clone()), ..Choice::default() }));
        let game = game.transpose()?;
        let link = ChaosLink::open(self.connect, self.robot)?;
        Ok(windows::open_chaos_window(assets, link, game.as_ref()))
    }

    fn fetch_image(
        &self,
        link: &mut ChaosLink,
        path: &Path,
        out: &mut impl Write,
    ) -> Result<Ending, CommandError> {
        let format = PictureFormat::of(path)?;
        check_writable(path).map_err(CommandError::file(path))?;
        link.subscribe(Subscription { images_hz: 10.0, data_hz: 2.0 });
        let talked = self.wait(link, |news| match news {
            ChaosNews::Image(data) => Some(data),
            _ => None,
        })?;
        let data = match self.told(link, talked, "picture")? {
            Ok(data) => data,
            Err(ending) => return Ok(ending),
        };
        let image = data.image();
        let bytes = format.write(&image).map_err(|why| DataError::new(path, why))?;
        write_whole(path, &bytes).map_err(CommandError::file(path))?;
        let (width, height) = (image.width, image.height);
        writeln!(out, "{} x {} pixels of {} in tick {}", width, height, self.robot, data.tick)?;
        Ok(Ending::Done)
    }

    fn print_data(&self, link: &mut ChaosLink, out: &mut impl Write) -> Result<Ending, CommandError> {
        link.subscribe(Subscription { images_hz: 0.0, data_hz: 10.0 });
        let talked = self.wait(link, |news| match news {
            ChaosNews::Debug(data) => Some(*data),
            _ => None,
        })?;
        match self.told(link, talked, "data")? {
            Ok(data) => {
                print_json(&data, out)?;
                Ok(Ending::Done)
            }
            Err(ending) => Ok(ending),
        }
    }

    /// Gives orders, one after the other, as long as they are carried out.
    fn give(
        &self,
        link: &mut ChaosLink,
        orders: Vec<Instruction>,
        out: &mut impl Write,
    ) -> Result<Ending, CommandError> {
        for order in orders {
            let number = link.order(order, self.timeout);
            let talked = self
                .wait(link, |news| matches!(news, ChaosNews::Accepted(it) if it == number).then_some(()))?;
            if let Err(ending) = self.told(link, talked, "answer")? {
                return Ok(ending);
            }
        }
        writeln!(out, "accepted by {}", self.robot)?;
        Ok(Ending::Done)
    }

    /// Waits for what is wanted of the news.
    fn wait<T>(
        &self,
        link: &mut ChaosLink,
        wanted: impl Fn(ChaosNews) -> Option<T>,
    ) -> Result<Talked<T>, NetworkError> {
        let interrupt = Interrupt::listen();
        let begin = Instant::now();
        loop {
            let left = self.timeout.saturating_sub(begin.elapsed());
            for news in link.poll(left.min(LOOK))? {
                match news {
                    ChaosNews::Refused(_, refusal) => return Ok(Talked::Refused(refusal)),
                    news => {
                        if let Some(told) = wanted(news) {
                            return Ok(Talked::Told(told));
                        }
                    }
                }
            }
            if interrupt.is_asked() {
                return Ok(Talked::Interrupted);
            }
            if left.is_zero() {
                return Ok(Talked::Silence);
            }
        }
    }

    /// What was told; else how the command ends, after a line that says why.
    fn told<T>(
        &self,
        link: &ChaosLink,
        talked: Talked<T>,
        what: &str,
    ) -> Result<Result<T, Ending>, CommandError> {
        let (address, patience) = (self.connect, self.timeout);
        Ok(Err(match talked {
            Talked::Told(told) => return Ok(Ok(told)),
            Talked::Interrupted => Ending::Interrupted,
            Talked::Refused(Refusal { what, why }) => {
                tell(format_args!("{} refuses the {what}: {why}", self.robot));
                Ending::BadInput
            }
            Talked::Silence if !link.has_heard() => {
                return Err(NetworkError::NoAnswer { address, patience }.into());
            }
            Talked::Silence => {
                let lost = link.figures().expired;
                let seconds = patience.as_secs_f32();
                tell(format_args!(
                    "{} at {address} has sent no whole {what} within {seconds} s; of {lost} messages parts are missing",
                    self.robot
                ));
                Ending::Failed
            }
        }))
    }
}
