; run --set X,Y.kenngr.kasto_achse=1 --set channel.m_synch[97]=MNE_SNS --set channel.kasto_residual_path=50000 --input x120.csv: exit 0
; page 206219787 edge banding in one block (G108)
; end X150 Y150
; passes X123.53553 Y123.53553
N05 X0 Y0 F20000
N10 G108
N20 G01 X90 Y90 F20000
N30 M97 G01 X150 Y150 F2000
N40 M30
