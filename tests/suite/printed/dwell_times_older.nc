; run: exit 0
; page 15556644491 dwell times, older form
N10 G04 X4.13
N20 G04 2.13
N30 #TIME 4.13
N40 M30
