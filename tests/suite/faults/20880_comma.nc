; check: exit 1
; error 20880 at 4:5
; error K-0019 at 4:1
#CAX[S C]
M30
