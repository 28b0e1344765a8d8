import type { SentEvent } from './messages';

const FIELDS = [
  ...['button', 'buttons', 'pointerId', 'pointerType', 'deltaX', 'deltaY', 'deltaMode'],
  ...['key', 'ctrlKey', 'metaKey', 'shiftKey', 'altKey'],
];

/** Returns the fields of an event that a worker needs; positions are relative to the element. */
export function sentEvent(event: Event, element: Element): SentEvent {
  const fields = Object.fromEntries(
    FIELDS.filter((name) => name in event).map((name) => [name, event[name as keyof Event]]),
  ) as Record<string, string | number | boolean>;
  if (!(event instanceof MouseEvent)) return { type: event.type, ...fields };
  const { left, top } = element.getBoundingClientRect();
  const [x, y] = [event.clientX - left, event.clientY - top];
  return { type: event.type, ...fields, clientX: x, clientY: y, pageX: x, pageY: y };
}
