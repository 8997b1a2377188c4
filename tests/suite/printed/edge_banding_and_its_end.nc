; run --set X,Y.kenngr.kasto_achse=1 --set channel.m_synch[33]=MNE_SNS --set channel.kasto_residual_path=50000 --input x120.csv: exit 0
; page 285989771 M function at the signal of edge banding (MNE_SNS)
; end X200 Y200
; passes X123.53553 Y123.53553
N05 G01 X0 Y0 F20000
N10 G108
N20 G01 X90 Y90 F20000
N30 G01 X150 Y150 M33 F2000
N40 G107
N50 G00 X200 Y200
N60 M30
