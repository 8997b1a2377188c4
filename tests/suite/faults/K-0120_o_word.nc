; check: exit 1
; error K-0120 at 3:1
o1000 sub
G1 X#1
o1000 endsub
M2
