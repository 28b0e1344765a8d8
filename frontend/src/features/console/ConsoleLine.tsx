import { Fragment, memo } from 'react';
import { openFile } from '@/store/project/navigation';
import type { LogLine } from '@/store/session/types';
import { parseAnsi } from './ansi';
import classes from './console.module.css';
import { findLinks } from './links';

interface ConsoleLineProps {
  readonly line: LogLine;
  readonly files: ReadonlySet<string>;
}

export const ConsoleLine = memo(function ConsoleLine({ line, files }: ConsoleLineProps) {
  // The engine numbers nodes without a name of their own: `Forward::6`.
  const node = (line.node_path.split('/').at(-1) ?? '').replace(/::\d+$/, '');
  return (
    <div className={classes['line']} data-level={line.level} data-source={line.source}>
      <span className={classes['time']}>{line.time.toFixed(2)}</span>
      <span className={classes['source']} title={line.node_path || line.source}>
        {node || line.source}
      </span>
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
