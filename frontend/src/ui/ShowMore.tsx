import { Button, Loader, type ButtonProps } from '@mantine/core';

interface Props extends Pick<ButtonProps, 'size' | 'variant' | 'children'> {
  readonly isLoading: boolean;
  readonly onClick: () => void;
  readonly 'data-testid'?: string;
}

/** The button below a list of pages; it takes clicks, and keeps the focus, also while a page is loaded. */
export function ShowMore({ isLoading, children, ...props }: Props) {
  return (
    <Button
      {...props}
      aria-busy={isLoading}
      rightSection={isLoading ? <Loader size={14} aria-hidden="true" /> : null}
    >
      {children}
    </Button>
  );
}
