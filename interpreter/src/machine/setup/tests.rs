use super::*;

#[test]
fn the_builtin_machine_converts_without_a_message() {
    let (machine, _) = Machine::builtin(&[]).unwrap();
    let (chains, diagnostics) = machine.chains();
    assert_eq!(diagnostics, []);
    assert_eq!(chains.len(), 4);
}
