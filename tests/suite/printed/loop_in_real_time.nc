; check: exit 1
; page 793352331 loop in real time (#RT WHILE)
; error K-0019 at 6:6
; error K-0019 at 9:6
N010 G01 X0 Y0 Z0 F1000
N020 #RT WHILE
N040 X100
N070 X0
N090 #RT ENDWHILE
N110 M30
