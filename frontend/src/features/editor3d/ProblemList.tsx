import { Button } from '@mantine/core';
import { IconAlertTriangle, IconBulb } from '@tabler/icons-react';
import { useRef } from 'react';
import { useTranslation } from 'react-i18next';
import { rewrite } from '@/model/document/rewrite';
import type { Json } from '@/model/document/values';
import type { DocumentProblem } from '@/model/document/yaml';
import { aimAt, openFile } from '@/store/project/navigation';
import { change, isReadOnly, select, textsOf, type Editor } from './editing';
import classes from './editor3d.module.css';

interface ProblemListProps {
  readonly problems: readonly DocumentProblem[];
  /** The files of the document. */
  readonly paths: readonly string[];
  /** The heading above problems of the whole document. */
  readonly title: string;
  readonly editor?: Editor;
}

const SHOWN = 50;

/** A list of the document's problems, each with links to its line and its thing. */
export function ProblemList({ problems, paths, title, editor }: ProblemListProps) {
  const { t } = useTranslation('editor3d');
  const section = useRef<HTMLElement>(null);
  if (problems.length === 0) return null;
  const repaired = () => {
    const list = section.current;
    // The list goes away with its last problem.
    (problems.length > 1 ? list : list?.parentElement)?.focus();
  };
  const go = ({ line, thing, text }: DocumentProblem) => {
    if (editor) {
      editor.store.setState({ isTextShown: true, shownText: text });
      if (thing !== null) select(editor, [thing]);
    }
    const path = paths[text];
    if (path === undefined) return;
    if (editor && text > 0) aimAt(path, line);
    else openFile(path, line);
  };
  return (
    <section ref={section} className={classes['problems']} tabIndex={-1} aria-label={title}>
      <h2>{title}</h2>
      <ul>
        {problems.slice(0, SHOWN).map((problem, index) => (
          <li key={index}>
            <button type="button" onClick={() => go(problem)}>
              <IconAlertTriangle size={14} aria-hidden="true" />
              <span className={classes['line']}>
                {paths.length > 1 ? `${paths[problem.text]?.split('/').at(-1) ?? ''} · ` : ''}
                {t('line', { line: problem.line })}
              </span>
              <span>
                {problem.path.length > 0 && problem.kind !== 'missing' ? (
                  <code>{problem.path.join('.')}</code>
                ) : null}{' '}
                {t(`problem.${problem.kind}`, problem.params)}
              </span>
            </button>
            <Repair problem={problem} editor={editor} onDone={repaired} />
          </li>
        ))}
      </ul>
    </section>
  );
}

interface RepairProps {
  readonly problem: DocumentProblem;
  /** Called after the repair: its button may be gone. */
  readonly onDone: () => void;
  readonly editor: Editor | undefined;
}

/** Returns the value of what a problem says: true, false, a text in quotes, or a number as YAML has it, like .5 or 007. */
const valueOf = (write: string): Json => (/^["tf]/.test(write) ? (JSON.parse(write) as Json) : Number(write));

/** A button that writes what the problem says, if it says that; one undo takes it back. */
function Repair({ problem: { params, path, text }, editor, onDone }: RepairProps) {
  const { t } = useTranslation('editor3d');
  const write = params['write'];
  if (!editor || isReadOnly() || typeof write !== 'string') return null;
  return (
    <Button
      size="compact-xs"
      variant="light"
      leftSection={<IconBulb size={13} aria-hidden="true" />}
      onClick={() => {
        change(editor, 'repair', () => {
          const value = valueOf(write);
          return {
            texts: textsOf(editor).map((each, index) =>
              index === text ? rewrite(each, [{ kind: 'set', path, value }]) : each,
            ),
          };
        });
        onDone();
      }}
    >
      {t('repair', { write })}
    </Button>
  );
}
