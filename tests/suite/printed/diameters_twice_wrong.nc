; check: exit 1
; page 250819723 diagnosis 20115, wrong
; error 20115 at 6:13
; error 20042 at 6:5
N10 G90 G01 F1000
N20 G51 X80 G51
N30 M30
