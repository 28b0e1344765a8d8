import { Button, ScrollArea, Text, UnstyledButton } from '@mantine/core';
import { IconCopy } from '@tabler/icons-react';
import type { ReactNode } from 'react';
import { useTranslation } from 'react-i18next';
import { copyText } from '@/ui/copying';
import classes from './importReport.module.css';

/** A line of a report. */
export interface ReportRow {
  readonly key: string;
  /** The line as it is copied. */
  readonly text: string;
  readonly icon: ReactNode;
  readonly content: ReactNode;
  readonly severity?: string;
  /** Opens the line's place, if it has one in the project. */
  readonly onOpen?: () => void;
}

/** Lines of a report under one heading. */
export interface ReportPart {
  readonly heading: string;
  readonly rows: readonly ReportRow[];
  readonly isFolded?: boolean;
  /** The number of lines that are shown, and the text that says how many more there are. */
  readonly most?: { readonly count: number; readonly more: (count: number) => string };
}

/** The lines of an import's report: parts that fold, and a button that copies all of them. */
export function ReportSections({ parts }: { readonly parts: readonly ReportPart[] }) {
  const { t } = useTranslation('importReport');
  const shown = parts.filter(({ rows }) => rows.length > 0);
  if (shown.length === 0) return null;
  const text = shown
    .map(({ heading, rows }) => [heading, ...rows.map((row) => `  ${row.text}`)].join('\n'))
    .join('\n');
  return (
    <div>
      <ScrollArea.Autosize mah="40vh">
        {shown.map((part) => (
          <Part key={part.heading} part={part} />
        ))}
      </ScrollArea.Autosize>
      <Button
        mt="xs"
        size="compact-xs"
        variant="subtle"
        leftSection={<IconCopy size={14} aria-hidden="true" />}
        onClick={() => void copyText(text, { done: t('copied'), failed: t('notCopied') })}
      >
        {t('copy')}
      </Button>
    </div>
  );
}

function Part({ part: { heading, rows, isFolded = false, most } }: { readonly part: ReportPart }) {
  const shown = rows.slice(0, most?.count);
  return (
    <details className={classes['part']} open={!isFolded}>
      <summary className={classes['heading']}>{heading}</summary>
      <ul className={classes['rows']}>
        {shown.map((row) => (
          <li key={row.key}>
            <Row row={row} />
          </li>
        ))}
      </ul>
      {most && rows.length > shown.length ? (
        <Text size="xs" c="dimmed">
          {most.more(rows.length - shown.length)}
        </Text>
      ) : null}
    </details>
  );
}

function Row({ row: { icon, content, severity, onOpen } }: { readonly row: ReportRow }) {
  if (!onOpen) {
    return (
      <div className={classes['row']} data-severity={severity}>
        {icon}
        {content}
      </div>
    );
  }
  return (
    <UnstyledButton className={classes['row']} data-severity={severity} onClick={onOpen}>
      {icon}
      {content}
    </UnstyledButton>
  );
}
