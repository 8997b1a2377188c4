; run --set X,Y.kenngr.kasto_achse=1 --set channel.m_synch[97]=MNE_SNS: exit 1
; page 15556670091 edge banding in one block, without a signal
; error K-0133 at 7:1
N10 X0 Y0 F20000
N20 G108
N30 G01 X90 Y90 F20000
N40 M97 G01 X150 Y150 F2000
N50 M30
