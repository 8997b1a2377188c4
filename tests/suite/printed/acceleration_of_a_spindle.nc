; run: exit 0
; page 300335499 weight of the acceleration of a spindle
N10 S[G130=70]
N20 M03 S1000
N30 S[G130=60]
N40 M04 S1000
N120 S[G130=100]
N130 M30
