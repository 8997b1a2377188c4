; run --set channel.synchro_data.koppel_gruppe[0].paar[0].log_achs_nr_master=1 --set channel.synchro_data.koppel_gruppe[0].paar[0].log_achs_nr_slave=3: exit 0
; end X15 Y0 Z10
(group 0 is that of the channel list: axis 3 follows axis 1)
N10 #SET AX [X,1,0][Y,2,1][C,3,3]
N20 #ENABLE AX LINK [0]
N30 G00 X10
N40 #DISABLE AX LINK [0]
N50 X15
N60 M30
