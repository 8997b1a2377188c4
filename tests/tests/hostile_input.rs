//! The targets of the fuzzer under bounded random input: everything of each kind in the repository, and mutations of it.
//!
//! `COUNT=100000 SEED=7 cargo test --release -p kontur-tests --test all hostile_input` runs for longer.

use kontur_kit::{Random, count, seed};
use kontur_tests::targets::{TARGETS, corpus, dictionary, mutated};
use std::panic::{AssertUnwindSafe, catch_unwind};

fn feed(name: &str, cases: usize) {
    let (_, target) = TARGETS.into_iter().find(|(n, _)| *n == name).unwrap();
    let (corpus, words) = (corpus(name), dictionary());
    let mut random = Random::new(seed());
    let changed = (0..count(cases)).map(|_| {
        let [input, other] = [0, 1].map(|_| &corpus[random.below(corpus.len())]);
        mutated(input, other, &words, &mut random)
    });
    for data in corpus.iter().cloned().chain(changed) {
        if let Err(panic) = catch_unwind(AssertUnwindSafe(|| target(&data))) {
            println!("--- {name}:\n{}\n---", String::from_utf8_lossy(&data));
            std::panic::resume_unwind(panic);
        }
    }
}

#[test]
fn programs_that_are_checked() {
    feed("check", 2000);
}

#[test]
fn programs_that_run() {
    feed("run", 450);
}

#[test]
fn lists_of_machines() {
    feed("lists", 300);
}

#[test]
fn inputs_of_a_run() {
    feed("inputs", 60);
}

#[test]
fn recordings() {
    feed("recording", 200);
}

#[test]
fn traces_to_compare() {
    feed("diff", 300);
}

#[test]
fn command_lines() {
    feed("command_line", 2000);
}

#[test]
fn pictures_and_pages() {
    feed("report", 40);
}
