import { IconCode, IconPlayerPlay, IconPointer, IconSparkles } from '@tabler/icons-react';
import type { Block, Spans, Try } from '@/model/lesson/parse';
import classes from './lesson.module.css';

interface Actor {
  readonly onTry: (act: Try) => void;
}

const ICONS = { select: IconPointer, set: IconSparkles, open: IconCode, run: IconPlayerPlay };

function TryButton({ text, act, onTry }: Actor & { readonly text: string; readonly act: Try }) {
  const Icon = ICONS[act.kind];
  return (
    <button type="button" className={classes['try']} data-try={act.kind} onClick={() => onTry(act)}>
      <Icon size={14} aria-hidden="true" />
      {text}
    </button>
  );
}

function Inline({ spans, onTry }: Actor & { readonly spans: Spans }) {
  return spans.map((span, index) => {
    switch (span.kind) {
      case 'try':
        return <TryButton key={index} text={span.text} act={span.act} onTry={onTry} />;
      case 'strong':
        return <strong key={index}>{span.text}</strong>;
      case 'emphasis':
        return <em key={index}>{span.text}</em>;
      case 'code':
        return <code key={index}>{span.text}</code>;
      case 'text':
        return span.text;
    }
  });
}

function Piece({ block, onTry }: Actor & { readonly block: Block }) {
  switch (block.kind) {
    case 'heading': {
      // The title of the page has level 1.
      const Tag = (['h2', 'h3', 'h4'] as const)[block.level - 1] ?? 'h4';
      return (
        <Tag>
          <Inline spans={block.spans} onTry={onTry} />
        </Tag>
      );
    }
    case 'paragraph':
      return (
        <p>
          <Inline spans={block.spans} onTry={onTry} />
        </p>
      );
    case 'code':
      return <pre>{block.text}</pre>;
    case 'list': {
      const Tag = block.isOrdered ? 'ol' : 'ul';
      return (
        <Tag>
          {block.items.map((spans, index) => (
            <li key={index}>
              <Inline spans={spans} onTry={onTry} />
            </li>
          ))}
        </Tag>
      );
    }
  }
}

/** The text of a lesson, with its *Try it* buttons. */
export function LessonText({ blocks, onTry }: Actor & { readonly blocks: readonly Block[] }) {
  return (
    <article className={classes['text']}>
      {blocks.map((block, index) => (
        <Piece key={index} block={block} onTry={onTry} />
      ))}
    </article>
  );
}
