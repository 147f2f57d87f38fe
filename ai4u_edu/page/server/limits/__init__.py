"""Limits of what a client may take from a server: connections, time, bytes, guesses and rates.

uvicorn limits none of these by itself, and a class has no reverse proxy in front that would. See
``docs/adr/0003-limits-of-connections.md``. What each module is there against:

================== ================================================================================
listener           more connections than there are file descriptors: refused before they cost
                   anything, and a lack of descriptors does not end the server
connections        one address that takes all connections: a limit for each, and idle ones give way
requests           requests that never end, heads of any size, and answers that nobody reads
frames             WebSocket handshakes, pings and closes that never end; frames that are none
timeouts           the time limits of all of these
plain_response     their answers, which are written without an app
request_target     requests for anything but a path, which a proxy would pass on elsewhere
json_body          bodies of any size, and JSON that other sites send
concurrency_limit  one seat or network that keeps everything busy that is open at the same time
rate_limit         floods of messages and requests
attempts           guessing of tokens and join codes
socket_close       sockets that a browser would be refused without a reason
keepalive          networks that are gone without a word: pages hear from the server, or reconnect
================== ================================================================================
"""
