; A damping of 1 has no oscillation to suppress, no kernel exists: error 50820.
%FAIL_50820
N10 G71 G90 G01 F1000
N20 #VIB GUARD ON [FREQ=40 DAMPING=1]
N30 X1
N40 M30
