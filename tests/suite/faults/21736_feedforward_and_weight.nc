; check: exit 1
; error 21736 at 3:22
S[M3 REV1000 G136=80 G130=60]
M30
