; run: exit 0
; page 208038923 position of the main spindle, second part of the example
N10 M05 S100
N20 M19 S.POS180
N30 M19 S200 S.POS90
N40 M30
