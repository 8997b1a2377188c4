; check: exit 1
; page 250811019 diagnosis 20113, wrong
; warning K-0114 at 5:18
; error 20113 at 6:9
N10 G00 X0 Y0 Z0 G42
N20 G25 G25
N30 M30
