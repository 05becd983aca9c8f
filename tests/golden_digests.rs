//! How the shipped teams play, tick by tick: a change of play that nobody meant is seen here.
//!
//! The digests stand in `tests/golden/digests.snap`. Where play is meant to change, this writes them anew:
//! `INSTA_UPDATE=always cargo test --no-default-features --test matches golden_digests`.

use std::collections::BTreeSet;
use std::fmt::Write;

use touchline::data::AssetKind;
use touchline::game::{Choice, Match, MatchPlan};
use touchline::rng::{Dice, Seed};
use touchline::world::sense::ImageEyes;
use xxhash_rust::xxh3::xxh3_64_with_seed;

use crate::support::assets;

/// A match of which the digest is kept.
struct ReferenceMatch {
    file: &'static str,
    home: &'static str,
    away: &'static str,
    radio: &'static str,
    /// So long it is played at most.
    seconds: f64,
}

const fn reference(
    file: &'static str,
    home: &'static str,
    away: &'static str,
    radio: &'static str,
    seconds: f64,
) -> ReferenceMatch {
    ReferenceMatch { file, home, away, radio, seconds }
}

/// All shipped matches, strategies and radios.
const MATCHES: &[ReferenceMatch] = &[
    reference("friendly", "hammerheads_2001", "ball_chasers", "good", 120.0),
    reference("friendly", "hammerheads_swap", "hammerheads_2000", "awful", 120.0),
    reference("friendly", "hammerheads_swap_paper", "hammerheads_2001", "bursty", 120.0),
    reference("friendly", "cs_freiburg", "art", "perfect", 120.0),
    reference("friendly", "optimal_assignment", "cs_freiburg", "odin", 120.0),
    reference("friendly", "hammerheads_swap", "ball_chasers", "nora", 120.0),
    reference("friendly", "rmit", "italian_golem", "good", 120.0),
    reference("friendly", "hammerheads_2001", "hammerheads_swap", "dead", 120.0),
    reference("four_legged_2005", "chaos_b3p", "chaos_plain", "good", 120.0),
    reference("four_legged_2005", "chaos_b3p_paper", "ball_chasers", "awful", 120.0),
    reference("four_legged_2005", "hammerheads_swap", "chaos_b3p", "bursty", 120.0),
    reference("friendly_images", "hammerheads_2001", "ball_chasers", "good", 15.0),
    reference("four_legged_images", "chaos_b3p", "chaos_plain", "good", 15.0),
    reference("friendly", "hammerheads_booking", "hammerheads_swap", "good", 120.0),
];

/// Minutes of a half, so that most of the matches come to their end.
const HALF: f32 = 0.5;

fn name(name: &str) -> Option<String> {
    Some(name.to_owned())
}

impl ReferenceMatch {
    /// The digest of the match, and of the last pictures of all robots that see by pictures.
    fn digests(&self, seed: u64) -> (u64, Option<u64>) {
        let choice = Choice {
            file: name(self.file),
            home: name(self.home),
            away: name(self.away),
            radio: name(self.radio),
            half_minutes: Some(HALF),
            seed,
            ..Choice::default()
        };
        let mut game = Match::new(&MatchPlan::read(&assets(), &choice).expect("the shipped files are sound"));
        while game.clock().now() < self.seconds && !game.is_over() {
            game.tick();
        }
        let mut eyes = game.world_mut().query::<&ImageEyes>();
        let pixels = eyes.iter(game.world()).flat_map(|eyes| &eyes.image().pixels);
        let pictures = pixels
            .map(|pixel| [pixel.y, pixel.u, pixel.v])
            .fold(None, |digest, pixel| Some(xxh3_64_with_seed(&pixel, digest.unwrap_or_default())));
        (game.record().digest, pictures)
    }
}

/// The digest of the distributions that are worked out of uniform numbers.
fn digest_of_dice() -> u64 {
    let mut dice = Dice::new(Seed(1), "golden", None);
    let values = (0..100_000).map(|_| [dice.normal(1.0), dice.exponential(1.0)].map(f32::to_bits));
    values.flatten().fold(0, |digest, bits| xxh3_64_with_seed(&bits.to_le_bytes(), digest))
}

#[test]
#[cfg_attr(not(target_arch = "x86_64"), ignore = "the digests were taken with the vector units of x86-64")]
fn reference_matches_are_played_as_ever() {
    let mut text = format!("{:016x} dice\n", digest_of_dice());
    for (seed, reference) in (1..).zip(MATCHES) {
        let ReferenceMatch { file, home, away, radio, seconds } = reference;
        let (digest, pictures) = reference.digests(seed);
        let _ = write!(
            text,
            "{digest:016x} {file}: {home} against {away}, radio {radio}, seed {seed}, {seconds} s"
        );
        let _ = pictures.map(|pictures| write!(text, "; the last pictures are {pictures:016x}"));
        text.push('\n');
    }
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("golden");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.set_description(
        "Each line is a match. Where its digest is another one, it is played otherwise than before. If that is meant, write all \
         anew: INSTA_UPDATE=always cargo test --no-default-features --test matches golden_digests",
    );
    settings.bind(|| insta::assert_snapshot!("digests", text));
}

#[test]
fn every_shipped_match_strategy_and_radio_is_in_a_reference_match() {
    let played: BTreeSet<String> =
        MATCHES.iter().flat_map(|m| [m.file, m.home, m.away, m.radio]).map(str::to_owned).collect();
    for kind in [AssetKind::Match, AssetKind::Strategy, AssetKind::Radio] {
        let missing: Vec<String> =
            assets().names(kind).into_iter().filter(|shipped| !played.contains(shipped)).collect();
        assert!(missing.is_empty(), "no reference match plays {kind:?} {missing:?}");
    }
}
