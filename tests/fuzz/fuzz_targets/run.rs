//! Target `run` of the fuzzer, with a time budget.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| kontur_fuzz::within_budget(data, kontur_tests::targets::run));
