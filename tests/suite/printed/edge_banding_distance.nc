; run --set X,Y.kenngr.kasto_achse=1 --set channel.m_synch[97]=MNE_SNS --input x25.csv: exit 0
; page 206230027 distance to go of edge banding (V.G.RW)
; end X40 Y20 Z10
; passes X29.743416 Y16.581139
N10 G91 G00 X0 Y0 Z10
N20 V.G.RW = 5
N30 G108
N40 G01 X10 Y10 F300
N50 M97 G01 X30 Y10 F200
N60 M30
