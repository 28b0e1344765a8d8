import type { TFunction } from 'i18next';
import { Fragment, memo } from 'react';
import type { TreeNode } from '@/generated/messages';
import { lookAt } from '@/store/moment/looking';
import { useProjectStore } from '@/store/project';
import { openFile, openTree } from '@/store/project/navigation';
import type { LogLine } from '@/store/session/types';
import { parseAnsi } from './ansi';
import classes from './console.module.css';
import { findLinks } from './links';

interface ConsoleLineProps {
  readonly line: LogLine;
  readonly files: ReadonlySet<string>;
  /** The block that printed the line, if the running tree has it. */
  readonly node: TreeNode | undefined;
  /** The name of the launch node that printed the line. */
  readonly launched: string | undefined;
  /** Whether the recording has the moment of the line. */
  readonly isRecorded: boolean;
  /** The texts of the console: a hook in each line takes longer than the line. */
  readonly t: TFunction<'console'>;
}

function showBlock({ tree_id, node_id }: TreeNode): void {
  openTree(tree_id);
  useProjectStore.getState().reveal(tree_id, node_id);
}

export const ConsoleLine = memo(function ConsoleLine(props: ConsoleLineProps) {
  const { line, files, node, launched, isRecorded, t } = props;
  if (line.run !== undefined)
    return (
      <div className={classes['divider']} role="separator" aria-label={t('run', { count: line.run })}>
        {t('run', { count: line.run })}
      </div>
    );
  // The engine adds a number to the path of an unnamed node: `Forward::6`.
  const name = (line.node_path.split('/').at(-1) ?? '').replace(/::\d+$/, '');
  const said = name || launched || line.source;
  return (
    <div className={classes['line']} data-level={line.level} data-source={line.source}>
      {isRecorded ? (
        <button
          type="button"
          className={classes['moment']}
          title={t('lookAt')}
          onClick={() => lookAt(line.time)}
        >
          {line.time.toFixed(2)}
        </button>
      ) : (
        <span className={classes['time']}>{line.time.toFixed(2)}</span>
      )}
      {node?.node_id ? (
        <button
          type="button"
          className={classes['block']}
          title={t('showBlock', { path: line.node_path })}
          onClick={() => showBlock(node)}
        >
          {said}
        </button>
      ) : (
        <span className={classes['source']} title={line.node_path || said}>
          {said}
        </span>
      )}
      <span className={classes['text']}>
        {parseAnsi(line.text).map((span, index) => (
          <span key={index} data-ansi={span.styles.join(' ') || undefined}>
            {findLinks(span.text, files).map((piece, at) =>
              'path' in piece ? (
                <button
                  key={at}
                  type="button"
                  className={classes['link']}
                  onClick={() => openFile(piece.path, piece.line)}
                >
                  {piece.text}
                </button>
              ) : (
                <Fragment key={at}>{piece.text}</Fragment>
              ),
            )}
          </span>
        ))}
      </span>
    </div>
  );
});
