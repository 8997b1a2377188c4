; check: exit 1
; error K-0006 at 4:4
%L SELF
LL SELF
M17
%MAIN
LL SELF
M30
