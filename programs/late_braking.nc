; Where the path brakes to a lower feed: at the end of the faster block (G900, initial state, G09 for one block), or under
; G901 after it, in the slower block. The words act on the end of their block; not with the slope HSC.
; v = 150, 100, 75, 50 and 25 mm/s over 20 mm each.
;   N20 to N30   G901: 150 mm/s up to X20, braking after it
;   N30 to N40   G09: 75 mm/s are reached at X40
;   N40 to N50   G901 again: braking after X60
;   N50 to N60   G900: 25 mm/s are reached at X80
%LATE_BRAKING
N10 G71 G90 G00 X0
N20 G01 G901 X20 F9000
N30 G09 X40 F6000
N40 X60 F4500
N50 G900 X80 F3000
N60 X100 F1500
N70 M30
