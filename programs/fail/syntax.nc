; Four mistakes; kontur check names them all.
%FAIL_SYNTAX
N10 G71 G90 G01 X1 F1000
N20 G777
N30 X1 Y2 X3
N40 #FOO
N50 X[2*[P1+3]
N60 M30
