//! Plays a match and writes everything that is wanted of it.

use std::collections::BTreeMap;

use serde::Serialize;

use super::drawing::{moment_figures, pitch_drawing, score_figures};
use super::forks::{PageForks, lost_before_goals, most_telling, play_forks};
use super::gif::GifRecorder;
use super::log::LogWriter;
use super::moment::{MatchMoment, MatchWatch};
use super::page::{PageFork, PageRecorder};
use super::svg::svg_of;
use super::trails::Trails;
use crate::clock::Clock;
use crate::game::{Match, MatchPlan};

/// What is to be written of a match. Ticks count those that are over.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ExportWishes {
    /// A page.
    pub page: Option<PageWish>,
    /// A log in the format MCAP.
    pub log: bool,
    /// A picture of this tick.
    pub picture: Option<u64>,
    /// A film from one tick until another.
    pub film: Option<(u64, u64)>,
}

/// How a page is to be.
#[derive(Clone, Debug, PartialEq)]
pub struct PageWish {
    /// The other futures that it has.
    pub forks: PageForks,
}

/// What was written of a match.
#[derive(Clone, Debug, Default)]
pub struct Exported {
    /// The page.
    pub page: Option<String>,
    /// The log.
    pub log: Option<Vec<u8>>,
    /// The picture.
    pub picture: Option<String>,
    /// The film.
    pub film: Option<Vec<u8>>,
    /// How much of it there is.
    pub counts: ExportCounts,
}

/// How much was written of a match.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ExportCounts {
    /// Ticks that were played.
    pub ticks: u64,
    /// Goals, home first.
    pub score: [u32; 2],
    /// That of the match.
    pub digest: String,
    /// On the page: messages, events, other futures.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub page: Option<PageCounts>,
    /// In the log: messages by topic.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub log: Option<BTreeMap<String, u64>>,
    /// Frames of the film.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub frames: Option<usize>,
}

/// How much there is on a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct PageCounts {
    /// Packets of messages.
    pub messages: usize,
    /// Events on the time line.
    pub events: usize,
    /// Other futures.
    pub forks: usize,
}

/// Why a match could not be written.
#[derive(Debug, thiserror::Error)]
pub enum ExportError {
    /// A person wanted it to end.
    #[error("interrupted")]
    Interrupted,
    /// The match does not last so long.
    #[expect(missing_docs, reason = "the sentence of the error says what its fields are")]
    #[error("the match has {ticks} ticks, so that there is nothing at tick {wanted}")]
    TooLate { wanted: u64, ticks: u64 },
    /// The log cannot be written.
    #[error("the log: {0}")]
    Log(#[from] mcap::McapError),
    /// The film cannot be written.
    #[error("the film: {0}")]
    Film(#[from] ::gif::EncodingError),
}

/// How long the trails of a picture are, ticks.
const TRAIL: u64 = 180;
/// Ticks between two questions whether to go on.
const ASK_EVERY: u64 = 600;

/// Plays a match, until a tick if one is given, and writes what is wanted of it. `goes_on` hears of the ticks that are over, and of the
/// work on forks afterwards, as if it were ticks.
///
/// # Errors
/// If it is to stop, the match does not last so long, or something cannot be written.
pub fn export(
    plan: &MatchPlan,
    last: Option<u64>,
    wishes: ExportWishes,
    goes_on: &mut dyn FnMut(u64) -> bool,
) -> Result<Exported, ExportError> {
    let mut game = Match::new(plan);
    let mut watch = MatchWatch::new(game.world_mut());
    let mut writers = Writers::new(plan, wishes, &game)?;
    loop {
        let moment = watch.look(game.world());
        writers.observe(&moment)?;
        if moment.tick.is_multiple_of(ASK_EVERY) && !goes_on(moment.tick) {
            return Err(ExportError::Interrupted);
        }
        if game.is_over() || last.is_some_and(|last| moment.tick >= last) {
            break;
        }
        game.tick();
    }
    writers.finish(plan, &watch, &game, goes_on)
}

struct Writers {
    wishes: ExportWishes,
    page: Option<PageRecorder>,
    log: Option<LogWriter>,
    trails: Trails,
    picture: Option<String>,
    film: Option<GifRecorder>,
    /// The scores with the ticks from which on they stood.
    scores: Vec<(u64, [u32; 2])>,
    ball_radius: f32,
    name: String,
    plan_pitch: crate::pitch::Pitch,
}

impl Writers {
    fn new(plan: &MatchPlan, wishes: ExportWishes, game: &Match) -> Result<Writers, ExportError> {
        let dt = game.clock().dt;
        Ok(Writers {
            page: wishes.page.as_ref().map(|_| PageRecorder::new(plan, dt)),
            log: wishes.log.then(|| LogWriter::new(plan)).transpose()?,
            trails: Trails::new(TRAIL),
            picture: None,
            film: wishes.film.and_then(|stretch| GifRecorder::new(plan, stretch, dt)),
            scores: Vec::new(),
            ball_radius: plan.ball.radius,
            name: plan.name.clone(),
            plan_pitch: plan.pitch.clone(),
            wishes,
        })
    }

    fn observe(&mut self, moment: &MatchMoment) -> Result<(), ExportError> {
        if self.scores.last().is_none_or(|(_, known)| *known != moment.score) {
            self.scores.push((moment.tick, moment.score));
        }
        if let Some(page) = &mut self.page {
            page.observe(moment);
        }
        if let Some(log) = &mut self.log {
            log.observe(moment)?;
        }
        if let Some(film) = &mut self.film {
            film.observe(moment)?;
        }
        if self.wishes.picture.is_some_and(|tick| moment.tick <= tick) {
            self.trails.observe(moment);
        }
        if self.wishes.picture == Some(moment.tick) {
            self.picture = Some(self.picture_of(moment));
        }
        Ok(())
    }

    fn picture_of(&self, moment: &MatchMoment) -> String {
        let mut drawing = pitch_drawing(&self.plan_pitch);
        drawing.figures.extend(moment_figures(moment, &self.trails, self.ball_radius, true));
        let score = score_figures(moment, &drawing);
        drawing.figures.extend(score);
        svg_of(&drawing, &format!("{} at {:.2} s, tick {}", self.name, moment.seconds, moment.tick))
    }

    fn finish(
        self,
        plan: &MatchPlan,
        watch: &MatchWatch,
        game: &Match,
        goes_on: &mut dyn FnMut(u64) -> bool,
    ) -> Result<Exported, ExportError> {
        let ticks = game.clock().tick;
        let wanted = [self.wishes.picture, self.wishes.film.map(|(from, _)| from)];
        if let Some(wanted) = wanted.into_iter().flatten().find(|wanted| *wanted > ticks) {
            return Err(ExportError::TooLate { wanted, ticks });
        }
        let digest = game.record().digest;
        let (score, digest_text) = (game.state().score, format!("{digest:016x}"));
        let counts = ExportCounts { ticks, score, digest: digest_text, ..ExportCounts::default() };
        let mut exported = Exported { picture: self.picture, counts, ..Exported::default() };
        if let Some((mut page, wish)) = self.page.zip(self.wishes.page) {
            page.note_under_way(watch.under_way());
            let forks = play_wished(plan, (wish.forks, &page), &self.scores, game, &mut || goes_on(ticks));
            forks.ok_or(ExportError::Interrupted)?.into_iter().for_each(|fork| page.add_fork(fork));
            let page = page.finish(digest);
            let [messages, events, forks] = page.counts();
            exported.counts.page = Some(PageCounts { messages, events, forks });
            exported.page = Some(page.to_html());
        }
        if let Some(log) = self.log {
            let (bytes, counts) = log.finish(watch.under_way())?;
            (exported.log, exported.counts.log) = (Some(bytes), Some(counts));
        }
        if let Some(film) = self.film {
            let (bytes, frames) = film.finish()?;
            (exported.film, exported.counts.frames) = (Some(bytes), Some(frames));
        }
        Ok(exported)
    }
}

/// Plays the other futures that a page is to have, to the end of the match at most; none if it is to stop.
fn play_wished(
    plan: &MatchPlan,
    (wish, page): (PageForks, &PageRecorder),
    scores: &[(u64, [u32; 2])],
    game: &Match,
    goes_on: &mut dyn FnMut() -> bool,
) -> Option<Vec<PageFork>> {
    let score_at = |tick: u64| {
        let known = scores.iter().take_while(|(from, _)| *from <= tick).last();
        known.map_or([0; 2], |(_, score)| *score)
    };
    let Clock { tick: end, dt } = game.clock();
    let (mut forks, most) = match wish {
        PageForks::Given(forks) => (forks, None),
        PageForks::BeforeGoals(most) => {
            (lost_before_goals(page, &plan.script, f64::from(dt), 2 * most), Some(most))
        }
    };
    forks.iter_mut().for_each(|fork| fork.until = fork.until.min(end));
    let played = play_forks(plan, &forks, score_at, goes_on)?;
    Some(match most {
        Some(most) => most_telling(played, most, score_at),
        None => played,
    })
}
