//! Many pieces of work on all cores, handed over one by one as they are done.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;

use rayon::prelude::*;

/// Does the work, the first piece first, with a state that each core begins for itself, and hands each result over in this thread;
/// until it is told to stop. What is being done then comes to its end and is handed over, too.
///
/// # Errors
/// The first one of what takes the results.
pub(super) fn on_all_cores<T: Send, S, R: Send, E>(
    pieces: impl Iterator<Item = T> + Send,
    begin: impl Fn() -> S + Sync + Send,
    work: impl Fn(&mut S, T) -> R + Sync + Send,
    mut take: impl FnMut(R) -> Result<bool, E>,
) -> Result<(), E> {
    let (sender, receiver) = mpsc::channel();
    let stop = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let stop = &stop;
        scope.spawn(move || {
            let pieces = pieces.take_while(|_| !stop.load(Ordering::Relaxed)).par_bridge();
            pieces.map_init(begin, work).for_each_with(sender, |sender, done| drop(sender.send(done)));
        });
        let mut ended = Ok(());
        for done in receiver {
            match take(done) {
                Ok(true) => continue,
                Ok(false) => {}
                Err(error) => ended = ended.and(Err(error)),
            }
            stop.store(true, Ordering::Relaxed);
        }
        ended
    })
}

#[cfg(test)]
mod tests {
    use std::convert::Infallible;

    use super::*;

    #[test]
    fn every_piece_is_done_once() {
        let mut done = Vec::new();
        let Ok(()) = on_all_cores(
            0..500,
            || (),
            |(), piece| 2 * piece,
            |result| {
                done.push(result);
                Ok::<_, Infallible>(true)
            },
        );
        done.sort_unstable();
        assert!(done.into_iter().eq((0..500).map(|piece| 2 * piece)));
    }

    #[test]
    fn work_without_end_stops_when_it_is_told_to_and_the_first_error_is_told() {
        let mut taken = 0;
        let ended = on_all_cores(
            0_u64..,
            || (),
            |(), piece| piece,
            |_| {
                taken += 1;
                if taken < 10 { Ok(true) } else { Err(taken) }
            },
        );
        assert_eq!(ended, Err(10));
    }
}
