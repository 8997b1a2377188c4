; check --set channel.configuration.decoder.msg_to_default=ERROR: exit 1
; error 22195 at 3:1
#MSG ["a"]
M30
