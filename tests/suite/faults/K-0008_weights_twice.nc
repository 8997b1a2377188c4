; check: exit 1
; error K-0008 at 9:9
; error K-0008 at 10:10
; error K-0008 at 11:10
; error K-0008 at 12:9
; error K-0008 at 13:6
; warning K-0100 at 13:1
; error K-0008 at 14:5
G131=50 G131=60
G130 X60 G131=50
G230 X50 G231=50
G129=50 G129=60
G193 G09 X1 F100
G09 G293 X2
M30
