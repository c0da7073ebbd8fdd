"""Keeps foreign turns of phrase out of what users and developers read.

  check_words.py [--list] [--all] SOURCE [PATH ...]

Pages (README.md, doc/, README.md of packages and inputs, packaging), public headers, and the texts in sources (schema, messages, notes)
are searched for the turns of TURNS; each entry has the plain form. --all: comments in all sources, tests and scripts, too. --list:
counts per turn. PATH: those files or folders only. Exit code 1 when a turn is found.
"""
import argparse
import pathlib
import re
import sys

NOUNS = 'row|line|column|value|file|entry|number|text|set|word|name|node|message|figure|call|sum|test|page|byte|unknown|pair|level'
ONES = 'pair|row|line|node|body|subdomain|side|rank|element|step|unknown|contact|message|file|value|cell|run|set|point|piece|group|solve|vertex|column|dof'
# (pattern, plain form); the patterns read text in which line breaks and comment marks are single spaces.
TURNS = [
    (r'\bin space\b', '3D, in 3D'),
    (r'\bin the plane\b(?! of| of| and across| stress| strain)', '2D, in 2D'),
    (r'\bof (its|their|his|your|one\'s) own\b', 'its own, a separate'),
    (r'\b(stands?|stood|standing) (for|in for)\b', 'is, means, represents, replaces'),
    (r'\b(asks?|asked|asking) for\b', 'requests, needs; requested, required'),
    (r'\b(tells?|told|telling)\b', 'reports, prints, warns, shows'),
    (r'\b(is|are|was|were|been|be|being) said\b', 'is reported, is printed, is stated'),
    (r'\bwithout saying\b|\bsays so\b|\bsay so\b', 'reports it'),
    (r'\bbut for\b', 'except'),
    (r'\b(%s)s? an? (%s)\b' % (NOUNS, ONES), 'per, for each'),
    (r'\bgo(es)? over into\b', 'continue'),
    (r'\bbeliev(e|es|ed|ing)\b', 'assumed, predicted, trusted'),
    (r'(^|[.:;] )(Who|Whoever|Whose|By what)\b(?! [^.?!]*\?)', 'subject first: the noun or verb that is documented'),
    (r'\bfor what\b(?! in\b|, )(?! [^.?!]*\?)', 'the noun'),
    (r'\bfolder of (its|their) own\b', 'its own folder'),
    (r'\bas it were\b|\bso to speak\b', '(delete)'),
    (r'\brounding\b(?! mode| error)', 'round-off'),
]
# A comment begins with what it documents.
OPENINGS = [(r'^([Oo]f|[Ww]hat|[Ww]hoever|[Ww]ho|[Bb]y what|[Ww]hose) ', 'subject first: the noun or verb that is documented')]

PAGES = ['README.md', 'CONTRIBUTING.md', 'CHANGELOG.md', 'doc', 'packages', 'input', 'packaging', 'python', 'drivers']
SKIPPED = {'build', 'build-dev', '.git', '__pycache__'}
EXEMPT = {'test/doc/check_words.py', 'test/doc/planted_words.py', 'doc/style.md'}  # they quote the turns
CONTRACTED = ['subdomains with physics of their own']  # names in tables that scripts rely on (doc/contract.md)


def files(source, paths, everything):
    names = paths or (PAGES if not everything else PAGES + ['test', 'cmake', '.ci'])
    for name in names:
        path = source / name
        found = [path] if path.is_file() else sorted(path.rglob('*')) if path.is_dir() else []
        for file in found:
            relative = file.relative_to(source)
            if file.is_file() and not SKIPPED & set(relative.parts) and str(relative) not in EXEMPT:
                yield file, relative


def pieces(file, relative, everything):
    """(line, text, is_comment) of a file's prose."""
    kind = file.suffix
    if kind not in ('.md', '.hpp', '.cpp', '.py', '.xml', '.sh', '.cmake', '.json', '.geo') and file.name != 'CMakeLists.txt':
        return
    text = file.read_text(encoding='utf-8', errors='replace')
    lines = text.split('\n')
    if kind == '.md':
        block, start, code = [], 1, False
        for number, line in enumerate(lines + [''], 1):
            if line.lstrip().startswith('```'):
                code = not code
                line = ''
            if code or not line.strip() or line.startswith(('    ', '|', '#', '- ')):
                if block:
                    yield start, ' '.join(block), False
                block = []
                if line.strip() and not code and not line.startswith('    '):
                    block, start = [line.strip(' |#-')], number
                continue
            if not block:
                start = number
            block.append(line.strip())
        if block:
            yield start, ' '.join(block), False
        return
    if kind in ('.hpp', '.cpp'):
        comment, start = [], 1
        for number, line in enumerate(lines + [''], 1):
            match = re.match(r'\s*///?<? ?(.*)$', line)
            trailing = None if match else re.search(r'(?<![:"])//+<? ?(.*)$', line)
            if match:
                if not comment:
                    start = number
                comment.append(match.group(1).strip())
                continue
            if comment and (kind == '.hpp' or everything):
                yield start, ' '.join(comment), True
            comment = []
            if trailing and (kind == '.hpp' or everything):
                yield number, trailing.group(1), True
            code = line[:trailing.start()] if trailing else line
            if not code.lstrip().startswith('#include'):
                for literal in re.findall(r'"((?:[^"\\]|\\.)*)"', code):
                    if ' ' in literal:
                        yield number, literal, False
        return
    if kind in ('.py', '.xml', '.json') or everything:
        for number, line in enumerate(lines, 1):
            if kind == '.py' and not everything and 'python' not in relative.parts and 'drivers' not in relative.parts:
                return
            yield number, line.strip(' #'), line.lstrip().startswith('#')


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument('--list', action='store_true')
    parser.add_argument('--all', action='store_true')
    parser.add_argument('source', type=pathlib.Path)
    parser.add_argument('paths', nargs='*')
    options = parser.parse_args()
    turns = [(re.compile(p), plain) for p, plain in TURNS]
    openings = [(re.compile(p), plain) for p, plain in OPENINGS]
    counts, found = {}, 0
    for file, relative in files(options.source.resolve(), options.paths, options.all):
        for line, text, is_comment in pieces(file, relative, options.all):
            if text in CONTRACTED:
                continue
            for pattern, plain in turns + (openings if is_comment else []):
                for match in pattern.finditer(text):
                    found += 1
                    counts[pattern.pattern] = counts.get(pattern.pattern, 0) + 1
                    if not options.list:
                        print(f'{relative}:{line}: "{match.group(0).strip()}": write {plain}\n    {text[max(0, match.start() - 60):match.end() + 60]}')
    if options.list:
        for pattern, count in sorted(counts.items(), key=lambda item: -item[1]):
            print(f'{count:6d}  {pattern}')
    print(f'{found} turns found')
    return 1 if found else 0


if __name__ == '__main__':
    sys.exit(main())
