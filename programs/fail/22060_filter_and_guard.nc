; #FILTER and #VIB GUARD in one program: error 22060 at the second command, nothing moves.
%FAIL_22060
N10 G71 G90 G01 F1000
N20 #FILTER ON [HSC]
N30 X1
N40 #FILTER OFF [HSC]
N50 #VIB GUARD ON
N60 X2
N70 M30
