"""The docs site: Sphinx pages made of ``docs/`` and of the package itself.

``python -m tests.docs_site`` builds it. The Markdown pages are read on GitHub, too, so they hold no
directives: tables of contents follow from the lists of links in ``README.md`` files, and what is
generated is put under the page whose name it bears (``docs/blocks.md``, ``docs/scenes.md``, ...).
"""
