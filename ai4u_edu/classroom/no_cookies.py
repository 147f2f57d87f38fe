"""Cookie jar for clients that speak for several people."""

from http.cookiejar import CookieJar, DefaultCookiePolicy


def no_cookies() -> CookieJar:
    """Return a jar that keeps nothing, so that no answer for one reaches the server for another."""
    return CookieJar(DefaultCookiePolicy(allowed_domains=[]))
