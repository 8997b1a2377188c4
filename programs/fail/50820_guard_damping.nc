; With a damping of 1 there is no oscillation to suppress and no kernel: error 50820.
%FAIL_50820
N10 G71 G90 G01 F1000
N20 #VIB GUARD ON [FREQ=40 DAMPING=1]
N30 X1
N40 M30
