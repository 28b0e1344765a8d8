import { IconAlertTriangle } from '@tabler/icons-react';
import { useTranslation } from 'react-i18next';
import type { DocumentProblem } from '@/model/document/yaml';
import { aimAt, openFile } from '@/store/project/navigation';
import { select, type Editor } from './editing';
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
  if (problems.length === 0) return null;
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
    <section className={classes['problems']} aria-label={title}>
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
          </li>
        ))}
      </ul>
    </section>
  );
}
