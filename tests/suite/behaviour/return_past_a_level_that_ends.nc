; run: exit 0
; end X6
; note K-0109 at 10:1
#FILE NAME [G80="called/calls_one_that_returns.nc"]
(A ends with G80, and the return from below leaves A once, not the main program as well)
LL A
X5
M30

%L A
G80 M17
