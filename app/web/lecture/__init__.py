"""A lecture as one self-contained HTML page, and its prints.

page.py composes the page; its scripts are among app/web/modules.
"""
